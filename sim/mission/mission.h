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

/// Where robots may start, with any heading unless said; always clear of walls, obstacles, objects
/// and each other.

/// Uniform in a disc (law of radius and angle: rvr-automode facts, section 7).
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

/// The same poses in each run, one a robot.
struct PlaceAt {
  std::vector<Pose> poses;

  friend bool operator==(const PlaceAt&, const PlaceAt&) = default;
};

using Placement = std::variant<PlaceInDisc, PlaceInRectangle, PlaceAnywhere, PlaceAt>;

/// A task and the place where it is done.
struct Mission {
  std::string name;
  Arena arena;
  ShuffledPatches shuffled;
  int robots = 3;
  Robot robot = rvr();  ///< what each of them is
  int cycles = 1200;    ///< duration in control cycles of 0.1 s
  Placement placement = PlaceInDisc{};
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

/// What is wrong with the obstacles and objects of an arena whose walls are right, as a sentence:
/// an obstacle outside of the walls (it may reach into them, and into other obstacles), an object
/// without room. Nothing when all is well.
std::optional<std::string> misplaced_solid(const Arena& arena);

/// Placement and patch colours of a seed. Fails when the robots do not fit into the arena, or those
/// that have fixed places do not fit there.
Expected<Instance> instance_of(const Mission& mission, std::int64_t seed);

/// Whether a robot of the instance begins in a wall, in something in the arena, or in another
/// robot. Never of an instance that was drawn.
bool has_overlaps(const Mission& mission, const Instance& instance);

/// The arena with the instance's patches on its floor.
Arena arena_of(const Mission& mission, const Instance& instance);

}  // namespace swarmsmith
