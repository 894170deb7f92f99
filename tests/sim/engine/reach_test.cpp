#include "sim/engine/internal/reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/motion.h"
#include "tests/sim/engine/islands.h"

namespace swarmsmith {
namespace {

/// Robots with their set-points, and what the reach test says of them.
struct Scene {
  Surroundings around = surroundings_of(dodecagon_of_the_thesis());
  std::vector<Mover> robots;

  std::vector<Island> islands(int sub_steps = 10) const {
    double speed_limit = 0;
    double radius = 0;
    for (const Mover& a : robots) {
      speed_limit =
          std::max({speed_limit, hypot(a.body.vx, a.body.vy), hypot(a.set_point.vx, a.set_point.vy),
                    std::fabs(a.set_point.spin) * kTreadDistance_m / 2});
      radius = std::max(radius, a.form().radius_m);
    }
    Places places(robots.size());
    places.update(robots);
    Reach reach(around, robots.size(), radius);
    const auto found = reach.find({robots, places, speed_limit}, sub_steps);
    return {found.begin(), found.end()};
  }
};

Mover standing(double x, double y, double theta = 0) {
  return {.body = body_at({x, y, theta}), .set_point = {}};
}

TEST(Reach, RobotsThatStandApartAreFree) {
  EXPECT_TRUE(
      (Scene{.robots = {standing(0, 0), standing(0.4, 0), standing(-0.4, 0.1)}}).islands().empty());
}

TEST(Reach, ARobotThatDrivesAtAnotherMakesAnIsland) {
  Scene scene{.robots = {standing(0, 0), standing(0.8, 0), standing(0.31, 0)}};
  EXPECT_TRUE(scene.islands().empty());
  scene.robots[0].set_point.vx = 0.3;
  const std::vector<Island> islands = scene.islands();
  ASSERT_EQ(islands.size(), 1);
  EXPECT_EQ(islands[0].movers, (std::vector<int>{0, 2}));
  EXPECT_TRUE(islands[0].walls.empty());
}

TEST(Reach, ACornerThatCouldSwingRoundCounts) {
  Scene scene{.robots = {standing(0, 0), standing(0.32, 0)}};
  EXPECT_TRUE(scene.islands().empty());
  scene.robots[0].set_point.spin = 4;
  EXPECT_EQ(scene.islands().size(), 1);
}

TEST(Reach, WallsInReachAreNamed) {
  Scene scene{.robots = {standing(1.06, 0), standing(0, 0), standing(0, -1.07)}};
  EXPECT_TRUE(scene.islands().empty());
  scene.robots[0].set_point.vx = 0.3;
  const std::vector<Island> islands = scene.islands();
  ASSERT_EQ(islands.size(), 1);
  EXPECT_EQ(islands[0].movers, (std::vector<int>{0}));
  ASSERT_EQ(islands[0].walls.size(), 1);
  const WallPlane& wall =
      scene.around.walls.planes[static_cast<std::size_t>(islands[0].walls[0].other)];
  EXPECT_NEAR(wall.nx, 1, 1e-12);
}

TEST(Reach, ARobotThatMayBePushedReachesAsFarAsItsPusherDrives) {
  // 1 stands within the reach of 0; 2 is 25 mm beyond 1, which alone would stay where it is.
  Scene scene{.robots = {standing(0, 0), standing(0.29, 0), standing(0.601, 0)}};
  scene.robots[0].set_point.vx = 0.3;
  const std::vector<Island> islands = scene.islands();
  ASSERT_EQ(islands.size(), 1);
  EXPECT_EQ(islands[0].movers, (std::vector<int>{0, 1, 2}));
}

TEST(Reach, WhatRestsAgainstEachOtherIsFreeUntilSomethingMovesThere) {
  Scene scene{.robots = {standing(0, 0), standing(0.285, 0), standing(-0.5, 0)}};
  EXPECT_TRUE(scene.islands().empty());
  scene.robots[2].body.vx = 0.3;
  EXPECT_TRUE(scene.islands(5).empty());
  scene.robots[2].body.x = -0.3;
  const std::vector<Island> islands = scene.islands();
  ASSERT_EQ(islands.size(), 1);
  EXPECT_EQ(islands[0].movers, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(islands[0].pairs, (std::vector<Meeting>{{0, 1}, {0, 2}}));
}

TEST(Reach, FewerSubStepsReachLess) {
  Scene scene{.robots = {standing(0, 0), standing(0.31, 0)}};
  scene.robots[0].set_point.vx = 0.3;
  EXPECT_EQ(scene.islands(10).size(), 1);
  EXPECT_TRUE(scene.islands(5).empty());
}

/// A dense, restless swarm: commands change at random, so that robots keep running into each other.
class ReachOnRandomRuns : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Seeds, ReachOnRandomRuns, testing::Range(1, 9));

TEST_P(ReachOnRandomRuns, RobotsItCallsFreeMoveAsIfTheSolverRanEverywhere) {
  Rng rng(static_cast<std::uint64_t>(GetParam()));
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    scene.robots.push_back(standing(0.4 * i - 0.4, 0.1 * i, rng.uniform(-kPi, kPi)));
  }
  const auto solver = make_exact_solver(scene.around);
  const Island all = everything(3, scene.around);
  std::vector<Command> commands(3);
  int called_free = 0;
  for (int tick = 0; tick < 4000; ++tick) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double pace = rng.bernoulli(0.1) ? 0.3 : 0;
      if (rng.bernoulli(0.15)) {
        commands[i] = rng.bernoulli(0.7) ? Command{0.3, 0.3 - pace} : Command{-0.3, 0.3};
      }
      scene.robots[i].set_point = set_point_of(commands[i], scene.robots[i].body);
    }
    const std::vector<Island> islands = scene.islands();
    std::vector<Mover> solved = scene.robots;
    solver->advance(solved, {&all, 1}, 10);
    for (int i = 0; i < 3; ++i) {
      const bool in_island = std::any_of(islands.begin(), islands.end(), [&](const Island& island) {
        return std::count(island.movers.begin(), island.movers.end(), i) > 0;
      });
      if (in_island) continue;
      ++called_free;
      const auto index = static_cast<std::size_t>(i);
      Body free = scene.robots[index].body;
      advance_freely(free, scene.robots[index].set_point, 10);
      ASSERT_NEAR(free.x, solved[index].body.x, 1e-12) << "tick " << tick;
      ASSERT_NEAR(free.y, solved[index].body.y, 1e-12) << "tick " << tick;
      ASSERT_NEAR(free.sin, solved[index].body.sin, 1e-12) << "tick " << tick;
    }
    scene.robots = solved;
  }
  EXPECT_GT(called_free, 1000);
}

/// The same for other outlines, objects, obstacles and walls that are not convex: Box2D, given
/// everything at once, moves those freely that it finds in no touch.
class ReachAmongSolids : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Seeds, ReachAmongSolids, testing::Range(1, 7));

Surroundings bent_room_with_obstacles() {
  Arena arena;
  arena.walls = {{{-1, -1}, {1, -1}},  {{1, -1}, {1, -0.2}}, {{1, -0.2}, {0.6, 0}},
                 {{0.6, 0}, {1, 0.2}}, {{1, 0.2}, {1, 1}},   {{1, 1}, {-1, 1}},
                 {{-1, 1}, {-1, -1}}};
  arena.obstacles = {{.outline = CircleOutline{0.08}, .pose = {-0.5, -0.5, 0}},
                     {.outline = BoxOutline{0.3, 0.05}, .pose = {-0.4, 0.5, 0.6}}};
  return surroundings_of(arena);
}

/// Movers that the islands leave out moved freely, to the last bits; what rests in a touch may do
/// so in single precision.
int check_free_ones(const std::vector<Mover>& before, const std::vector<Mover>& after,
                    const std::vector<Island>& islands) {
  int called_free = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool in_island = std::any_of(islands.begin(), islands.end(), [&](const Island& island) {
      return std::count(island.movers.begin(), island.movers.end(), static_cast<int>(i)) > 0;
    });
    if (in_island) continue;
    ++called_free;
    Body free = before[i].body;
    advance_freely(free, before[i].set_point, 10, before[i].dynamics());
    const double tolerance = free == before[i].body ? 1e-6 : 1e-12;
    EXPECT_NEAR(free.x, after[i].body.x, tolerance) << i;
    EXPECT_NEAR(free.y, after[i].body.y, tolerance) << i;
    EXPECT_NEAR(free.sin, after[i].body.sin, tolerance) << i;
  }
  return called_free;
}

TEST_P(ReachAmongSolids, MoversItCallsFreeMoveAsIfTheSolverRanEverywhere) {
  Rng rng(static_cast<std::uint64_t>(GetParam()));
  const std::vector<Outline> outlines = {CircleOutline{0.12}, BoxOutline{0.25, 0.1},
                                         PolygonOutline{{{0.2, 0}, {-0.1, 0.1}, {-0.1, -0.1}}}};
  const MoverKind robot = robot_kind(rvr_with(outlines[rng.below(3)]));
  const MoverKind object = object_kind(
      {.outline = outlines[rng.below(3)], .start = {}, .mass_kg = 0.3, .friction_N = 0.4});
  Scene scene{.around = bent_room_with_obstacles(), .robots = {}};
  const std::array<Point, 4> starts = {{{-0.75, 0}, {-0.25, 0}, {0.2, -0.5}, {0.2, 0.5}}};
  for (std::size_t i = 0; i < 4; ++i) {
    scene.robots.push_back({.body = body_at({starts[i].x, starts[i].y, rng.uniform(-kPi, kPi)}),
                            .set_point = {},
                            .kind = i < 3 ? &robot : &object});
  }
  const auto solver = make_box2d_solver(scene.around, false);
  const Island all = everything(4, scene.around);
  std::vector<Command> commands(3);
  int called_free = 0;
  for (int tick = 0; tick < 1500 && !HasFailure(); ++tick) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double speed = rng.bernoulli(0.2) ? 1.0 : 0.3;
      if (rng.bernoulli(0.15)) {
        commands[i] = rng.bernoulli(0.7) ? Command{speed, speed} : Command{-speed, speed};
      }
      scene.robots[i].set_point = set_point_of(commands[i], scene.robots[i].body);
    }
    const std::vector<Island> islands = scene.islands();
    const std::vector<Mover> before = scene.robots;
    solver->advance(scene.robots, {&all, 1}, 10);
    called_free += check_free_ones(before, scene.robots, islands);
  }
  EXPECT_GT(called_free, 500);
  RecordProperty("called_free", called_free);
}

}  // namespace
}  // namespace swarmsmith
