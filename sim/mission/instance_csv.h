#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Instances given in files instead of drawn, to compare with another simulator or to repeat a real
/// run.

/// A coloured patch, given by its centre; its size is the size of the mission's place at this
/// centre.
struct PatchPlacement {
  Point centre;
  Rgb color;

  friend bool operator==(const PatchPlacement&, const PatchPlacement&) = default;
};

using StartsBySeed = std::map<std::int64_t, std::vector<Pose>>;
using PatchesBySeed = std::map<std::int64_t, std::vector<PatchPlacement>>;

/// Reads `seed,robot,x,y,theta` (metres, radians), with columns in any order and one row per robot;
/// the robots of a seed are numbered from 0 and come in order. `where` of an error is the line,
/// counted from 1.
Expected<StartsBySeed> parse_starts_csv(std::string_view text);

/// Reads `seed,x,y,color` (metres; colours as in sim/mission/colors.h), one row per patch.
Expected<PatchesBySeed> parse_patches_csv(std::string_view text);

/// The tables that these two functions read, for instances by their seeds; numbers read back to the
/// same bits.
std::string starts_csv(const std::map<std::int64_t, Instance>& instances);
std::string patches_csv(const std::map<std::int64_t, Instance>& instances);

/// The explicitly given parts; the others are drawn from the seed.
struct ExplicitInstances {
  std::optional<StartsBySeed> starts;
  std::optional<PatchesBySeed> patches;  ///< ignored for a mission without shuffled patches
};

/// Like `instance_of(mission, seed)`, with explicit starts and patches if they are given. Errors: a
/// seed without a row, a wrong number of robots, a start outside the walls, a patch where the
/// mission has no place for one (to the millimetre), a second patch on the same place,
/// and other numbers of colours than the mission's.
Expected<Instance> instance_of(const Mission& mission, std::int64_t seed,
                               const ExplicitInstances& given);

}  // namespace swarmsmith
