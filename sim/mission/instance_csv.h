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

/// Instances written down in files instead of drawn: to compare with another simulator, or to
/// repeat a real run.

/// A coloured patch by its centre; its size is that of the mission's place there.
struct PatchPlacement {
  Point centre;
  Rgb color;

  friend bool operator==(const PatchPlacement&, const PatchPlacement&) = default;
};

using StartsBySeed = std::map<std::int64_t, std::vector<Pose>>;
using PatchesBySeed = std::map<std::int64_t, std::vector<PatchPlacement>>;

/// Reads `seed,robot,x,y,theta` (metres, radians), columns in any order, one row a robot, robots of
/// a seed counted from 0 in order. `where` of an error is the line, from 1.
Expected<StartsBySeed> parse_starts_csv(std::string_view text);

/// Reads `seed,x,y,color` (metres; colours as in sim/mission/colors.h), one row a patch.
Expected<PatchesBySeed> parse_patches_csv(std::string_view text);

/// The tables that these two read, of instances by their seeds; numbers read back to the same bits.
std::string starts_csv(const std::map<std::int64_t, Instance>& instances);
std::string patches_csv(const std::map<std::int64_t, Instance>& instances);

/// What is given explicitly; the rest is drawn from the seed.
struct ExplicitInstances {
  std::optional<StartsBySeed> starts;
  std::optional<PatchesBySeed> patches;  ///< not looked at by a mission without shuffled patches
};

/// Like `instance_of(mission, seed)`, with explicit starts and patches where given. A seed without
/// a row, another number of robots, a start outside of the walls, and a patch where the mission has
/// no place for one (to the millimetre), or a second one, and other numbers of colours than the
/// mission's are errors.
Expected<Instance> instance_of(const Mission& mission, std::int64_t seed,
                               const ExplicitInstances& given);

}  // namespace swarmsmith
