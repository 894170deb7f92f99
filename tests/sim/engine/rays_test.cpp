#include "sim/engine/internal/rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RayDistances nothing() {
  RayDistances distances;
  distances.fill(kInfinity);
  return distances;
}

/// A hexagon with a notch, so that a wall may hide another one.
Arena notched_arena() {
  Arena arena;
  const std::vector<Point> corners = {{1, 0},  {0.6, 0.9},  {0, 0.3},
                                      {-1, 1}, {-1.2, 0.0}, {-0.2, -1}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    arena.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return arena;
}

/// Distance along a ray to a segment, the plain way; infinity when it is missed.
double to_segment(Point start, Point direction, Point from, Point to) {
  const double ex = to.x - from.x;
  const double ey = to.y - from.y;
  const double cross = direction.x * ey - direction.y * ex;
  if (cross == 0) return kInfinity;
  const double fx = from.x - start.x;
  const double fy = from.y - start.y;
  const double t = (fx * ey - fy * ex) / cross;
  const double u = (fx * direction.y - fy * direction.x) / cross;
  return t >= 0 && u >= 0 && u <= 1 ? t : kInfinity;
}

std::vector<Wall> sides_of(const Body& body) {
  const double h = kHalfSide_m;
  const std::vector<Point> local = {{h, h}, {-h, h}, {-h, -h}, {h, -h}};
  std::vector<Wall> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto world = [&](Point p) {
      return Point{body.x + body.cos * p.x - body.sin * p.y,
                   body.y + body.sin * p.x + body.cos * p.y};
    };
    sides.push_back({world(local[i]), world(local[(i + 1) % 4])});
  }
  return sides;
}

/// All eight rays against all segments.
RayDistances plain_distances(const Body& self, const std::vector<Wall>& segments) {
  RayDistances distances = nothing();
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double angle = pose_of(self).theta + kProximityDirections_deg[i] * kPi / 180;
    const Point direction = {std::cos(angle), std::sin(angle)};
    const Point start = {self.x + kRayStart_m * direction.x, self.y + kRayStart_m * direction.y};
    for (const Wall& segment : segments) {
      distances[i] = std::min(distances[i], to_segment(start, direction, segment.from, segment.to));
    }
  }
  return distances;
}

/// Equal within rounding up to `range`; beyond it, only both beyond.
void expect_same(const RayDistances& got, const RayDistances& want, double range) {
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (want[i] <= range - 1e-9) {
      ASSERT_NEAR(got[i], want[i], 1e-9) << "ray " << i;
    } else {
      ASSERT_GE(got[i], range - 1e-9) << "ray " << i;
    }
  }
}

class RaysAtRange : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(All, RaysAtRange, testing::Values(0.1, 0.4, 2.0));

TEST_P(RaysAtRange, MeetTheWallsOfAConvexArenaAsThePlainWayDoes) {
  const Arena arena = dodecagon_of_the_thesis();
  const Walls walls = walls_of(arena);
  Rng rng(1);
  for (int i = 0; i < 3000; ++i) {
    const Body self =
        body_at({rng.uniform(-0.7, 0.7), rng.uniform(-0.7, 0.7), rng.uniform(-kPi, kPi)});
    RayDistances distances = nothing();
    meet_walls(self, kRayStart_m, walls, GetParam(), distances);
    expect_same(distances, plain_distances(self, arena.walls), GetParam());
  }
}

TEST_P(RaysAtRange, MeetTheNearestWallOfANotchedArena) {
  const Arena arena = notched_arena();
  const Walls walls = walls_of(arena);
  ASSERT_FALSE(walls.convex);
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    const Body self =
        body_at({rng.uniform(-0.4, 0.3), rng.uniform(-0.3, 0.0), rng.uniform(-kPi, kPi)});
    RayDistances distances = nothing();
    meet_walls(self, kRayStart_m, walls, GetParam(), distances);
    expect_same(distances, plain_distances(self, arena.walls), GetParam());
  }
}

TEST_P(RaysAtRange, MeetAnotherRobotAsThePlainWayDoes) {
  Rng rng(3);
  int hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Body self = body_at({0, 0, rng.uniform(-kPi, kPi)});
    const Body other =
        body_at({rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), rng.uniform(-kPi, kPi)});
    if (hypot(other.x, other.y) < 2 * kCornerRadius_m) continue;
    RayDistances distances = nothing();
    meet_robot(self, other, GetParam(), distances);
    expect_same(distances, plain_distances(self, sides_of(other)), GetParam());
    for (const double distance : distances)
      hits += distance <= GetParam() ? 1 : 0;
  }
  EXPECT_GT(hits, 50);
}

TEST(Rays, ThatStartInsideAnotherRobotDoNotMeetIt) {
  const Body self = body_at({0, 0, 0});
  const Body other = body_at({0.28, 0, 0});
  RayDistances distances = nothing();
  meet_robot(self, other, 2, distances);
  EXPECT_EQ(distances[1], kInfinity);
  // The diagonal rays start inside the own body, 51 mm from the other's face.
  EXPECT_NEAR(distances[0], (0.28 - kHalfSide_m) * std::sqrt(2) - kRayStart_m, 1e-12);
}

TEST(Rays, ThatStartBehindAWallReadZero) {
  const Walls walls = walls_of(dodecagon_of_the_thesis());
  const Body self = body_at({1.226 - 0.142, 0, 0});
  RayDistances distances = nothing();
  meet_walls(self, kRayStart_m, walls, 0.4, distances);
  EXPECT_EQ(distances[1], 0);
}

TEST(Rays, LimitsAreThoseOfTheSensor) {
  EXPECT_EQ(limited(0.0499, 0.4), -kInfinity);
  EXPECT_EQ(limited(0.05, 0.4), 0.05);
  EXPECT_EQ(limited(0.4, 0.4), 0.4);
  EXPECT_EQ(limited(0.4001, 0.4), kInfinity);
  EXPECT_EQ(limited(kInfinity, 0.4), kInfinity);
}

}  // namespace
}  // namespace swarmsmith
