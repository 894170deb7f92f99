#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// Colours that are laid on patches anew for each instance: `count` patches of each colour, the
/// rest of `places` stays floor. Empty for fixed floors.
struct ShuffledPatches {
  struct Share {
    Rgb color;
    int count = 0;

    friend bool operator==(const Share&, const Share&) = default;
  };
  std::vector<Rectangle> places;
  std::vector<Share> shares;

  friend bool operator==(const ShuffledPatches&, const ShuffledPatches&) = default;
};

/// A task and the place where it is done.
struct Mission {
  std::string name;
  Arena arena;
  ShuffledPatches shuffled;
  int robots = 3;
  int cycles = 1200;  ///< duration in control cycles of 0.1 s
  /// Robots start with their centres uniform in a disc of this radius around the origin (law of
  /// radius and angle: rvr-automode facts, section 7).
  double placement_radius_m = 1.2;
  ScoreRule rule;

  friend bool operator==(const Mission&, const Mission&) = default;
};

/// What one run starts from, a pure function of mission and seed, or given explicitly.
struct Instance {
  std::vector<Pose> starts;    ///< one a robot
  std::vector<Patch> patches;  ///< laid over the arena's own

  friend bool operator==(const Instance&, const Instance&) = default;
};

/// `aggregation`, `grid_exploration` or `color_selection` (thesis 6.3 to 6.5), all with the walls
/// of the thesis' program. An unknown name is an error that lists the known ones.
Expected<Mission> built_in_mission(std::string_view name);

/// Placement and patch colours of a seed. Fails when the robots do not fit into the arena.
Expected<Instance> instance_of(const Mission& mission, std::int64_t seed);

/// The arena with the instance's patches on its floor.
Arena arena_of(const Mission& mission, const Instance& instance);

/// Side of the robot's square body, metres (argos3-rvr; rvr-automode facts, section 2).
inline constexpr double kBodySide_m = 0.286;

}  // namespace swarmsmith
