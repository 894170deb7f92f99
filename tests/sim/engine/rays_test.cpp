#include "sim/engine/internal/rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/internal/sensing.h"
#include "tests/sim/engine/plain_rays.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Form kRvr = form_of(BoxOutline{kBodySide_m, kBodySide_m}, kBodyHeight_m);

RayDistances nothing() {
  RayDistances distances;
  distances.fill(kInfinity);
  return distances;
}

/// All eight rays against all segments.
RayDistances plain_distances(const Body& self, const std::vector<Wall>& segments) {
  RayDistances distances = nothing();
  for (std::size_t i = 0; i < kProximitySensors; ++i) {
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
  for (std::size_t i = 0; i < kProximitySensors; ++i) {
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
    meet_walls(self, ring_of(ProximityRing::rvr_ring()), kRayStart_m, walls, GetParam(), distances);
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
    meet_walls(self, ring_of(ProximityRing::rvr_ring()), kRayStart_m, walls, GetParam(), distances);
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
    expect_same(distances, plain_distances(self, sides_of(kRvr, other)), GetParam());
    for (const double distance : distances)
      hits += distance <= GetParam() ? 1 : 0;
  }
  EXPECT_GT(hits, 50);
}

TEST(Rays, MeetASquareLikeAnyOtherSolid) {
  Rng rng(4);
  for (int i = 0; i < 5000; ++i) {
    const Body self = body_at({0, 0, rng.uniform(-kPi, kPi)});
    const Body other =
        body_at({rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), rng.uniform(-kPi, kPi)});
    RayDistances quick = nothing();
    meet_robot(self, other, 0.4, quick);
    RayDistances general = nothing();
    meet_solid(self, ring_of(ProximityRing::rvr_ring()), kRayStart_m, kRvr, other, 0.4, general);
    expect_same(general, quick, 0.4);
  }
}

/// The eight rays of robots of this form in a notched arena full of things.
void expect_plain_distances_among_things(const Outline& robot, std::uint64_t seed) {
  Arena arena = notched_arena();
  furnish(arena);
  Rng rng(seed);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Pose> poses = {
        {rng.uniform(-0.1, 0.1), rng.uniform(-0.25, -0.1), rng.uniform(-kPi, kPi)},
        {rng.uniform(-0.6, -0.4), rng.uniform(0.0, 0.1), rng.uniform(-kPi, kPi)}};
    const World world(arena, rvr_with(robot), poses, ContactModel::Box2d);
    const double out = world.form(0).inradius_m;
    const RayDistances distances = ray_distances(world, 0, 0.4);
    RayDistances want{};
    for (std::size_t ray = 0; ray < kProximitySensors; ++ray) {
      const double angle = poses[0].theta + kProximityDirections_deg[ray] * kPi / 180;
      const Point direction = {std::cos(angle), std::sin(angle)};
      const Point start = {poses[0].x + out * direction.x, poses[0].y + out * direction.y};
      want[ray] = to_anything(start, direction, arena, world, 0);
      hits += want[ray] <= 0.4 ? 1 : 0;
    }
    expect_same(distances, want, 0.4);
  }
  EXPECT_GT(hits, 2000);
}

TEST(Rays, WhatIsKeptInMindOfWallsAndObstaclesChangesNoDistance) {
  Arena arena = notched_arena();
  furnish(arena);
  const std::vector<Pose> starts = {{0, -0.2, 0.3}, {-0.5, 0.05, 2}};
  for (const bool fast : {false, true}) {
    World world(arena, rvr(), starts, ContactModel::Box2d);
    ProximityRays rays(world, 0, 0.4);
    Rng rng(3);
    for (int cycle = 0; cycle < 500; ++cycle) {
      const double most = fast ? 1.55 : 0.3;
      world.command(0, {rng.uniform(-most, most), rng.uniform(-most, most)});
      world.advance(10);
      RayDistances distances{};
      rays.cast(distances);
      EXPECT_EQ(distances, ray_distances(world, 0, 0.4));
    }
  }
}

TEST(Rays, OfSquareRobotsMeetObstaclesObjectsAndWalls) {
  expect_plain_distances_among_things(BoxOutline{kBodySide_m, kBodySide_m}, 5);
}

TEST(Rays, OfRoundRobotsStartOnTheirRim) {
  expect_plain_distances_among_things(CircleOutline{0.1}, 6);
}

TEST(Rays, OfPolygonsStartOnTheInscribedCircle) {
  expect_plain_distances_among_things(
      PolygonOutline{{{0.12, 0}, {0.03, 0.08}, {-0.09, 0.06}, {-0.09, -0.06}, {0.03, -0.08}}}, 7);
}

TEST(Rays, StartOnTheInscribedCircle) {
  EXPECT_EQ(ray_start_m({}, kRvr), 0.143);
  EXPECT_DOUBLE_EQ(ray_start_m({}, form_of(BoxOutline{0.4, 0.2}, 0.1)), 0.1);
  EXPECT_EQ(ray_start_m({}, form_of(CircleOutline{0.09}, 0.1)), 0.09);
}

TEST(Rays, ThatStartInsideASolidDoNotMeetIt) {
  const Body self = body_at({0, 0, 0});
  RayDistances distances = nothing();
  meet_solid(self, ring_of(ProximityRing::rvr_ring()), 0.143, form_of(CircleOutline{0.1}, 0.1),
             body_at({0.2, 0, 0}), 2, distances);
  EXPECT_EQ(distances[1], kInfinity);
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
