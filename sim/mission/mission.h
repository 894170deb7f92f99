#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/score.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Colours that are distributed over places for each instance: `count` patches of each colour; the
/// remaining `places` keep the colour of the floor. Empty for missions with fixed floors.
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

/// The area in which robots may start, with any heading unless stated; starts are always clear of
/// walls, objects, each other, and obstacles unless the mission ignores them.

/// Uniform in a disc (formula for radius and angle: rvr-automode facts, section 7).
struct PlaceInDisc {
  Point centre;
  double radius_m = 1.2;

  friend bool operator==(const PlaceInDisc&, const PlaceInDisc&) = default;
};

/// Uniform in a rectangle.
struct PlaceInRectangle {
  Rectangle area;

  friend bool operator==(const PlaceInRectangle&, const PlaceInRectangle&) = default;
};

/// Uniform in the whole arena.
struct PlaceAnywhere {
  friend bool operator==(const PlaceAnywhere&, const PlaceAnywhere&) = default;
};

/// The same poses in each run, one per robot.
struct PlaceAt {
  std::vector<Pose> poses;

  friend bool operator==(const PlaceAt&, const PlaceAt&) = default;
};

using Placement = std::variant<PlaceInDisc, PlaceInRectangle, PlaceAnywhere, PlaceAt>;

/// A task, with its arena and score.
struct Mission {
  std::string name;
  Arena arena;
  ShuffledPatches shuffled;
  int robots = 3;
  Robot robot = rvr();  ///< the model of each of them
  int cycles = 1200;    ///< duration in control cycles of 0.1 s
  Placement placement = PlaceInDisc{};
  /// Whether robots may start inside obstacles, which they leave by driving.
  bool ignores_obstacles = false;
  ScoreRule rule;

  friend bool operator==(const Mission&, const Mission&) = default;
};

/// The start of one run: a pure function of mission and seed, or given explicitly.
struct Instance {
  std::vector<Pose> starts;    ///< one per robot
  std::vector<Patch> patches;  ///< in addition to the arena's own patches

  friend bool operator==(const Instance&, const Instance&) = default;
};

/// `aggregation`, `grid_exploration` or `color_selection` (thesis 6.3 to 6.5), all with the walls
/// of the thesis' program. An unknown name is an error that lists the known ones.
Expected<Mission> built_in_mission(std::string_view name);

/// The error in the obstacles and objects of an arena with correct walls, as a sentence: an
/// obstacle outside the walls (it may reach into them, and into other obstacles), or an object
/// without enough room. Nothing if there is no error.
std::optional<std::string> misplaced_solid(const Arena& arena);

/// Placement and patch colours for a seed. Fails when the robots do not fit into the arena, or do
/// not fit at their fixed places.
Expected<Instance> instance_of(const Mission& mission, std::int64_t seed);

/// Whether a robot of the instance begins in a wall, in something in the arena, or in another
/// robot. Never of an instance that was drawn.
bool has_overlaps(const Mission& mission, const Instance& instance);

/// The arena with the instance's patches on its floor.
Arena arena_of(const Mission& mission, const Instance& instance);

}  // namespace swarmsmith
