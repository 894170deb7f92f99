#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/math.h"
#include "base/overloaded.h"
#include "base/plain_text.h"
#include "base/rng.h"
#include "sim/mission/internal/ground.h"
#include "sim/mission/mission.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr int kTriesPerRobot = 1000;

/// The program's placement (rvr-automode facts, section 7): the larger of two uniform numbers gives
/// the radius, their ratio the angle; the result is uniform in the disc.
Point draw_in_disc(Rng& rng, const PlaceInDisc& disc) {
  const double u1 = rng.uniform();
  const double u2 = rng.uniform();
  const double large = std::max(u1, u2);
  const double small = std::min(u1, u2);
  const SinCos direction = sin_cos(large > 0 ? 2 * kPi * small / large : 0);
  const double radius = disc.radius_m * large;
  return {disc.centre.x + radius * direction.cos, disc.centre.y + radius * direction.sin};
}

Point draw_in_rectangle(Rng& rng, const Rectangle& area) {
  const double x = rng.uniform() - 0.5;
  const double y = rng.uniform() - 0.5;
  return {area.centre.x + x * area.width_m, area.centre.y + y * area.height_m};
}

/// Draws points until one lies within the walls. Points of the bounding rectangle outside the walls
/// do not count as tries.
Point draw_anywhere(Rng& rng, const Arena& arena, const Rectangle& bounds) {
  Point point;
  int draws = 0;
  do {
    point = draw_in_rectangle(rng, bounds);
  } while (!is_inside(arena, point) && ++draws < kTriesPerRobot);
  return point;
}

/// The error for a robot whose place in a file is blocked.
Unexpected misplaced(const Mission& mission, std::size_t robot, const std::string& by) {
  return bad_input("robot " + std::to_string(robot + 1) + " at " +
                       point_text(std::get<PlaceAt>(mission.placement).poses[robot].position()) +
                       " would stand in " + by + "; place it elsewhere",
                   mission.name);
}

/// The poses given by the mission, each checked for room.
Expected<std::vector<Pose>> given_starts(const Mission& mission, Ground ground) {
  const std::vector<Pose>& poses = std::get<PlaceAt>(mission.placement).poses;
  if (poses.size() != static_cast<std::size_t>(mission.robots)) {
    return bad_input("there are poses for " + counted(poses.size(), "robot") +
                         ", but the mission has " + std::to_string(mission.robots),
                     mission.name);
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Footprint body(mission.robot.body.outline, poses[i]);
    const std::string by = ground.blocked_by(body);
    if (!by.empty()) return misplaced(mission, i, by);
    ground.add(body, "robot " + std::to_string(i + 1));
  }
  return poses;
}

/// The arena with all that stands in it before the robots.
Ground ground_of(const Mission& mission) {
  const Arena& arena = mission.arena;
  Ground ground(arena, mission.ignores_obstacles);
  for (std::size_t i = 0; i < arena.objects.size(); ++i) {
    const MovableObject& object = arena.objects[i];
    ground.add({object.outline, object.start}, "object " + std::to_string(i + 1));
  }
  return ground;
}

Expected<std::vector<Pose>> draw_starts(const Mission& mission, Rng rng) {
  Ground ground = ground_of(mission);
  if (std::holds_alternative<PlaceAt>(mission.placement)) {
    return given_starts(mission, std::move(ground));
  }
  const Rectangle bounds = ground.bounds();
  const auto draw_point = Overloaded{
      [&](const PlaceInDisc& disc) { return draw_in_disc(rng, disc); },
      [&](const PlaceInRectangle& rectangle) { return draw_in_rectangle(rng, rectangle.area); },
      [&](const PlaceAnywhere&) { return draw_anywhere(rng, mission.arena, bounds); },
      [](const PlaceAt&) { return Point{}; }};
  std::vector<Pose> starts;
  for (int robot = 1; robot <= mission.robots; ++robot) {
    for (int tries = 0;; ++tries) {
      if (tries == kTriesPerRobot) {
        return bad_input("arena too small for " + counted(mission.robots, "robot") + ": none of " +
                             std::to_string(kTriesPerRobot) + " places for robot " +
                             std::to_string(robot) +
                             " was free; take fewer robots, or place them over a larger part of "
                             "the arena (training.placement)",
                         mission.name);
      }
      const Point point = std::visit(draw_point, mission.placement);
      // Rejection sampling: each try draws place and heading anew, so that all free poses are
      // equally likely.
      const Pose pose{point.x, point.y, wrap_angle(rng.uniform(0, 2 * kPi))};
      const Footprint body(mission.robot.body.outline, pose);
      if (!ground.blocked_by(body).empty()) continue;
      ground.add(body, "robot " + std::to_string(robot));
      starts.push_back(pose);
      break;
    }
  }
  return starts;
}

/// Colour by colour, puts each patch on a place drawn from the free places.
Expected<std::vector<Patch>> draw_patches(const ShuffledPatches& shuffled, Rng rng) {
  std::vector<Rectangle> free = shuffled.places;
  std::vector<Patch> patches;
  for (const ShuffledPatches::Share& share : shuffled.shares) {
    for (int i = 0; i < share.count; ++i) {
      if (free.empty()) return bad_input("there are more coloured patches than places for them");
      const auto chosen = static_cast<std::ptrdiff_t>(rng.below(free.size()));
      Patch& patch = patches.emplace_back();
      patch.shape = free[static_cast<std::size_t>(chosen)];
      patch.color = share.color;
      free.erase(free.begin() + chosen);
    }
  }
  return patches;
}

}  // namespace

Expected<Instance> instance_of(const Mission& mission, std::int64_t seed) {
  const Rng rng(static_cast<std::uint64_t>(seed));
  // Separate streams: the patches of a seed do not depend on how many places were tried for robots,
  // and stay the same if a table gives the starts.
  Expected<std::vector<Pose>> starts = draw_starts(mission, rng.split("placement"));
  if (!starts) return Unexpected(std::move(starts.error()));
  Expected<std::vector<Patch>> patches = draw_patches(mission.shuffled, rng.split("patches"));
  if (!patches) return Unexpected(std::move(patches.error()));
  return Instance{.starts = std::move(*starts), .patches = std::move(*patches)};
}

bool has_overlaps(const Mission& mission, const Instance& instance) {
  Ground ground = ground_of(mission);
  for (const Pose& start : instance.starts) {
    const Footprint body(mission.robot.body.outline, start);
    if (!ground.blocked_by(body).empty()) return true;
    ground.add(body, "robot");
  }
  return false;
}

Arena arena_of(const Mission& mission, const Instance& instance) {
  Arena arena = mission.arena;
  arena.patches.insert(arena.patches.end(), instance.patches.begin(), instance.patches.end());
  return arena;
}

}  // namespace swarmsmith
