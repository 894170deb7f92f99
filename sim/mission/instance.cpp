#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/math.h"
#include "base/rng.h"
#include "sim/mission/mission.h"

namespace swarmsmith {
namespace {

constexpr double kHalfSide_m = 0.5 * kBodySide_m;
constexpr int kTriesPerRobot = 1000;

/// A robot's square: centre and unit vector of the heading.
struct Square {
  Point centre;
  double cos = 1;
  double sin = 0;
};

Square square_of(const Pose& pose) {
  const SinCos heading = sin_cos(pose.theta);
  return {pose.position(), heading.cos, heading.sin};
}

/// Half the square's extent along the unit vector (x, y).
double reach_along(const Square& square, double x, double y) {
  return kHalfSide_m *
         (std::fabs(square.cos * x + square.sin * y) + std::fabs(square.cos * y - square.sin * x));
}

/// Separating axis test of two equal squares: they overlap unless one of the four face directions
/// shows a gap.
bool overlap(const Square& a, const Square& b) {
  const double dx = b.centre.x - a.centre.x;
  const double dy = b.centre.y - a.centre.y;
  const std::array<Point, 4> axes = {
      {{a.cos, a.sin}, {-a.sin, a.cos}, {b.cos, b.sin}, {-b.sin, b.cos}}};
  return std::all_of(axes.begin(), axes.end(), [&](Point axis) {
    const double distance = std::fabs(dx * axis.x + dy * axis.y);
    return distance < reach_along(a, axis.x, axis.y) + reach_along(b, axis.x, axis.y);
  });
}

/// Whether the square crosses the line of a wall. Enough for convex arenas, where the inside is the
/// left side of every wall.
bool crosses(const Square& square, const Wall& wall) {
  const double along_x = wall.to.x - wall.from.x;
  const double along_y = wall.to.y - wall.from.y;
  const double length = hypot(along_x, along_y);
  const double inward_x = -along_y / length;
  const double inward_y = along_x / length;
  const double distance =
      (square.centre.x - wall.from.x) * inward_x + (square.centre.y - wall.from.y) * inward_y;
  return distance < reach_along(square, inward_x, inward_y);
}

/// Law of the program's placement (rvr-automode facts, section 7): of two uniform numbers the
/// larger one gives the radius, their ratio the angle, which makes the disc's points equally
/// likely.
Pose draw_pose(Rng& rng, double radius_m) {
  const double u1 = rng.uniform();
  const double u2 = rng.uniform();
  const double large = std::max(u1, u2);
  const double small = std::min(u1, u2);
  const SinCos direction = sin_cos(large > 0 ? 2 * kPi * small / large : 0);
  const double radius = radius_m * large;
  const double heading = wrap_angle(rng.uniform(0, 2 * kPi));
  return {radius * direction.cos, radius * direction.sin, heading};
}

Expected<std::vector<Pose>> draw_starts(const Mission& mission, Rng rng) {
  std::vector<Pose> starts;
  std::vector<Square> placed;
  const auto is_free = [&](const Square& square) {
    const auto& walls = mission.arena.walls;
    return std::none_of(walls.begin(), walls.end(),
                        [&](const Wall& wall) { return crosses(square, wall); }) &&
           std::none_of(placed.begin(), placed.end(),
                        [&](const Square& other) { return overlap(square, other); });
  };
  for (int robot = 0; robot < mission.robots; ++robot) {
    int tries = 0;
    Pose pose;
    do {
      if (tries++ == kTriesPerRobot) {
        return bad_input("arena too small for " + std::to_string(mission.robots) +
                             " robots: none of " + std::to_string(kTriesPerRobot) +
                             " places for robot " + std::to_string(robot + 1) + " was free",
                         mission.name);
      }
      pose = draw_pose(rng, std::get<PlaceInDisc>(mission.placement).radius_m);
    } while (!is_free(square_of(pose)));
    starts.push_back(pose);
    placed.push_back(square_of(pose));
  }
  return starts;
}

/// Colour after colour, each patch on a place drawn from those still free.
Expected<std::vector<Patch>> draw_patches(const ShuffledPatches& shuffled, Rng rng) {
  std::vector<Rectangle> free = shuffled.places;
  std::vector<Patch> patches;
  for (const ShuffledPatches::Share& share : shuffled.shares) {
    for (int i = 0; i < share.count; ++i) {
      if (free.empty()) return bad_input("there are more coloured patches than places for them");
      const auto chosen = static_cast<std::ptrdiff_t>(rng.below(free.size()));
      patches.push_back({free[static_cast<std::size_t>(chosen)], share.color});
      free.erase(free.begin() + chosen);
    }
  }
  return patches;
}

}  // namespace

Expected<Instance> instance_of(const Mission& mission, std::int64_t seed) {
  const Rng rng(static_cast<std::uint64_t>(seed));
  Expected<std::vector<Pose>> starts = draw_starts(mission, rng.split("placement"));
  if (!starts) return Unexpected(std::move(starts.error()));
  Expected<std::vector<Patch>> patches = draw_patches(mission.shuffled, rng.split("patches"));
  if (!patches) return Unexpected(std::move(patches.error()));
  return Instance{.starts = std::move(*starts), .patches = std::move(*patches)};
}

Arena arena_of(const Mission& mission, const Instance& instance) {
  Arena arena = mission.arena;
  arena.patches.insert(arena.patches.end(), instance.patches.begin(), instance.patches.end());
  return arena;
}

}  // namespace swarmsmith
