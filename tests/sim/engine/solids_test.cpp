#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/internal/gaps.h"
#include "sim/engine/internal/world.h"
#include "sim/files/robot_file.h"
#include "tests/support/not_empty.h"

// Obstacles, movable objects, other outlines and walls that are not convex, in whole worlds.

namespace swarmsmith {
namespace {

const Robot kRvr = rvr();
/// The RVR's highest wheel speed, m/s (thesis facts, section 5).
constexpr double kFullSpeed_mps = 1.55;

/// A room of 4 m by 4 m around the origin.
Arena room() {
  Arena arena;
  arena.walls = {{{-2, -2}, {2, -2}}, {{2, -2}, {2, 2}}, {{2, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}};
  return arena;
}

/// The room with a block of 1 m by 1 m in the middle of its east side, made of walls: two reflex
/// corners at (1, -0.5) and (1, 0.5).
Arena bent_room() {
  Arena arena;
  arena.walls = {{{-2, -2}, {2, -2}},   {{2, -2}, {2, -0.5}}, {{2, -0.5}, {1, -0.5}},
                 {{1, -0.5}, {1, 0.5}}, {{1, 0.5}, {2, 0.5}}, {{2, 0.5}, {2, 2}},
                 {{2, 2}, {-2, 2}},     {{-2, 2}, {-2, -2}}};
  return arena;
}

/// Three forms for whatever must hold for all.
std::vector<Outline> outlines() {
  return {CircleOutline{0.1}, BoxOutline{0.3, 0.12},
          PolygonOutline{{{0.2, 0}, {-0.1, 0.15}, {-0.1, -0.15}}}};
}

void drive(World& world, const Command& command, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) {
    for (int robot = 0; robot < world.robots(); ++robot)
      world.command(robot, command);
    world.advance(10);
  }
}

/// By how much a mover stands in walls or obstacles, at most.
double depth_in_surroundings(const World& world, int mover) {
  double deepest = 0;
  for (const WallPlane& wall : world.walls().planes) {
    deepest = std::max(deepest, -gap_to(world.form(mover), world.body(mover), wall));
  }
  for (const FixedSolid& solid : world.obstacles()) {
    deepest =
        std::max(deepest, -gap_between(world.form(mover), world.body(mover), solid.form, solid.at));
  }
  return deepest;
}

TEST(Solids, OnlyPlainWorldsArePlain) {
  const std::vector<Pose> starts = {{0, 0, 0}};
  EXPECT_TRUE(World(room(), kRvr, starts, ContactModel::Exact).is_plain());
  EXPECT_FALSE(World(bent_room(), kRvr, starts, ContactModel::Exact).is_plain());
  EXPECT_FALSE(World(room(), rvr_with(CircleOutline{0.1}), starts, ContactModel::Exact).is_plain());
  Arena arena = room();
  arena.obstacles = {{.outline = CircleOutline{0.1}, .pose = {1, 1, 0}}};
  EXPECT_FALSE(World(arena, kRvr, starts, ContactModel::Exact).is_plain());
  arena = room();
  arena.objects = {{.outline = CircleOutline{0.1}, .start = {1, 1, 0}}};
  EXPECT_FALSE(World(arena, kRvr, starts, ContactModel::Exact).is_plain());
}

TEST(Solids, AnObstacleOfAnyFormStopsARobotOfAnyFormAtItsFace) {
  std::vector<Robot> robots = {find_robot("epuck", "").value()};  // discs have their own solver
  for (const Outline& outline : not_empty(outlines()))
    robots.push_back(rvr_with(outline));
  for (const Robot& robot : robots) {
    for (const Outline& obstacle : outlines()) {
      Arena arena = room();
      arena.obstacles = {{.outline = obstacle, .pose = {0.6, 0, kPi}}};
      World world(arena, robot, std::vector<Pose>{{0, 0, 0}}, ContactModel::Exact);
      const FixedSolid& solid = world.obstacles()[0];
      double least = 1;
      for (int tick = 0; tick < 40; ++tick) {
        drive(world, {0.3, 0.3}, 1);
        least = std::min(least, gap_between(world.form(0), world.body(0), solid.form, solid.at));
      }
      EXPECT_LT(least, 0.0005) << "it never touched";
      EXPECT_GT(least, -0.005);
    }
  }
}

/// Discs have their own solver.
TEST(Solids, AFaceStopsADiscWhereverItIsHit) {
  Arena arena = room();
  arena.obstacles = {{.outline = BoxOutline{0.2, 1}, .pose = {0.5, 0, 0}}};
  World world(arena, find_robot("epuck", "").value(), std::vector<Pose>{{0, 0.3, 0}},
              ContactModel::Exact);
  drive(world, {0.3, 0.3}, 40);
  EXPECT_NEAR(world.body(0).x, 0.4 - world.form(0).radius_m, 0.004);
  EXPECT_NEAR(world.body(0).y, 0.3, 0.001);
}

TEST(Solids, NearAnObstacleMotionIsFreeToTheLastBit) {
  Arena arena = room();
  arena.obstacles = {{.outline = BoxOutline{0.2, 2}, .pose = {0.5, 0, 0}}};
  World near(arena, kRvr, std::vector<Pose>{{0.255, -0.5, kPi / 2}}, ContactModel::Exact);
  World open(room(), kRvr, std::vector<Pose>{{0.255, -0.5, kPi / 2}}, ContactModel::Exact);
  for (World* world : {&near, &open})
    drive(*world, {0.3, 0.3}, 30);
  EXPECT_GT(near.solved_sub_steps(), 100);
  EXPECT_NEAR(near.body(0).x, open.body(0).x, 1e-14);
  EXPECT_NEAR(near.body(0).y, open.body(0).y, 1e-14);
}

TEST(Solids, AnObjectLeftAloneSlidesToRestByItsFriction) {
  // Pushed to some speed v by a robot that then backs away, it stops after v^2 m / (2 F).
  Arena arena = room();
  arena.objects = {
      {.outline = BoxOutline{0.2, 0.4}, .start = {0.3, 0, 0}, .mass_kg = 0.5, .friction_N = 0.2}};
  World world(arena, kRvr, std::vector<Pose>{{0, 0, 0}}, ContactModel::Exact);
  drive(world, {0.3, 0.3}, 20);
  const double speed = world.body(1).vx;
  const double from = world.body(1).x;
  EXPECT_NEAR(speed, 0.3, 0.01);
  drive(world, {-0.3, -0.3}, 20);
  EXPECT_EQ(world.body(1).vx, 0);
  EXPECT_NEAR(world.body(1).x - from, speed * speed * 0.5 / (2 * 0.2), 0.005);
}

TEST(Solids, ARobotPushesALightBoxAndNotAHeavyOne) {
  for (const double friction_N : {1.0, 1.8}) {
    Arena arena = room();
    arena.objects = {{.outline = BoxOutline{0.2, 0.4},
                      .start = {0.4, 0, 0},
                      .mass_kg = 1,
                      .friction_N = friction_N}};
    World world(arena, kRvr, std::vector<Pose>{{0, 0, 0}}, ContactModel::Exact);
    drive(world, {0.3, 0.3}, 50);
    const double moved = world.body(1).x - 0.4;
    if (friction_N < kMaxForce_N) {
      EXPECT_GT(moved, 0.5);
    } else {
      // The impact alone: 2 kg at 0.3 m/s against 3 kg that brake with what friction has over.
      EXPECT_LT(moved, 0.25);
      EXPECT_NEAR(world.body(1).vx, 0, 1e-3);
    }
  }
}

/// How far a box of 1.2 m by 0.3 m that 3.6 N hold goes in its last 20 s of 30 s, when so many
/// robots push it side by side.
double pushed_by(int robots) {
  Arena arena = room();
  arena.walls = {
      {{-2, -2}, {12, -2}}, {{12, -2}, {12, 2}}, {{12, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}};
  arena.objects = {
      {.outline = BoxOutline{0.3, 1.2}, .start = {0, 0, 0}, .mass_kg = 1, .friction_N = 3.6}};
  std::vector<Pose> starts;
  for (int i = 0; i < robots; ++i)
    starts.push_back({-0.35, 0.35 * (i - (robots - 1) / 2.0), 0});
  World world(arena, kRvr, starts, ContactModel::Exact);
  drive(world, {0.3, 0.3}, 100);
  const double from = world.body(robots).x;
  drive(world, {0.3, 0.3}, 200);
  EXPECT_NEAR(world.body(robots).y, 0, 0.02);
  return world.body(robots).x - from;
}

TEST(Solids, ABoxThatNeitherOneNorTwoRobotsMoveYieldsToThree) {
  EXPECT_NEAR(pushed_by(1), 0, 0.001);
  // Ten rounds leave a little: measured 1.4 mm in 20 s.
  EXPECT_NEAR(pushed_by(2), 0, 0.004);
  // 4.5 N drive, 3.6 N brake: they go as fast as commanded.
  EXPECT_NEAR(pushed_by(3), 20 * 0.3, 0.1);
}

TEST(Solids, ALightObjectBetweenARobotAndAWallIsNotPressedInto) {
  Arena arena = room();
  arena.objects = {
      {.outline = BoxOutline{0.1, 0.1}, .start = {1.9, 0, 0}, .mass_kg = 0.2, .friction_N = 0.2}};
  World world(arena, kRvr, std::vector<Pose>{{1.5, 0, 0}}, ContactModel::Exact);
  drive(world, {0.3, 0.3}, 1000);
  // What Box2D leaves is 5 mm; without pushing apart it was 47 mm.
  EXPECT_LT(depth_in_surroundings(world, 1), 0.006);
  EXPECT_LT(-gap_between(world.form(0), world.body(0), world.form(1), world.body(1)), 0.006);
}

TEST(Solids, AWallsReflexCornerStopsARobotThatDrivesAtIt) {
  World world(bent_room(), kRvr, std::vector<Pose>{{0, 0.55, 0}}, ContactModel::Exact);
  for (int tick = 0; tick < 60; ++tick) {
    drive(world, {0.3, 0.3}, 1);
    EXPECT_LT(depth_in_surroundings(world, 0), 0.005);
  }
  EXPECT_LT(world.body(0).x, 1 - kHalfSide_m + 0.005);
  // Half of its front is past the corner: what is beside is free to be turned into.
  World beside(bent_room(), kRvr, std::vector<Pose>{{0, 0.66, 0}}, ContactModel::Exact);
  drive(beside, {0.3, 0.3}, 60);
  EXPECT_GT(beside.body(0).x, 1.5);
}

TEST(Solids, SlidingAlongAWallARobotDoesNotCatchOnItsJoints) {
  Arena arena;
  // The north side in pieces of 0.1 m.
  arena.walls = {{{-2, -2}, {2, -2}}, {{2, -2}, {2, 0.2}}};
  for (int i = 0; i < 40; ++i) {
    arena.walls.push_back({{2 - 0.1 * i, 0.2}, {2 - 0.1 * (i + 1), 0.2}});
  }
  arena.walls.push_back({{-2, 0.2}, {-2, -2}});
  World world(arena, kRvr, std::vector<Pose>{{-1.6, 0, 0.1}}, ContactModel::Box2d);
  double slowest = 1;
  for (int tick = 0; tick < 80; ++tick) {
    drive(world, {0.3, 0.3}, 1);
    if (tick > 20) slowest = std::min(slowest, world.body(0).vx);
  }
  EXPECT_GT(slowest, 0.2);
  EXPECT_GT(world.body(0).x, 0);
}

TEST(Solids, AtFullSpeedNoRobotPassesThroughWallsOrObstacles) {
  Rng rng(7);
  for (const Outline& robot :
       {kRvr.body.outline, Outline{CircleOutline{0.06}}, Outline{BoxOutline{0.3, 0.12}}}) {
    Arena arena = bent_room();
    arena.obstacles = {{.outline = BoxOutline{0.02, 1}, .pose = {-1, 0, 0.3}},
                       {.outline = CircleOutline{0.03}, .pose = {0, 1.2, 0}},
                       {.outline = CircleOutline{0.3}, .pose = {0, -1.2, 0}}};
    World world(arena, rvr_with(robot), std::vector<Pose>{{0, 0, 0}, {1.5, 1.5, 0}, {1.5, -1.5, 0}},
                ContactModel::Exact);
    double deepest = 0;
    for (int tick = 0; tick < 3000; ++tick) {
      for (int i = 0; i < 3; ++i) {
        if (!rng.bernoulli(0.1)) continue;
        world.command(i, {rng.uniform(-1, 1) > 0 ? kFullSpeed_mps : -kFullSpeed_mps,
                          rng.bernoulli(0.8) ? kFullSpeed_mps : -kFullSpeed_mps});
      }
      world.advance(10);
      for (int i = 0; i < 3; ++i) {
        const Body& body = world.body(i);
        ASSERT_LT(std::max(std::fabs(body.x), std::fabs(body.y)), 2) << "tick " << tick;
        ASSERT_FALSE(body.x > 1 && std::fabs(body.y) < 0.5) << "tick " << tick;
        deepest = std::max(deepest, depth_in_surroundings(world, i));
      }
    }
    // A corner that spins at full speed moves 42 mm in a sub-step; measured at worst 30 mm.
    EXPECT_LT(deepest, 0.05);
    RecordProperty("deepest_um", static_cast<int>(deepest * 1e6));
  }
}

TEST(Solids, ASwarmAmongMixedSolidsKeepsThemApart) {
  Rng rng(3);
  Arena arena = bent_room();
  arena.obstacles = {{.outline = CircleOutline{0.2}, .pose = {-1, -1, 0}}};
  for (const Outline& outline : outlines()) {
    arena.objects.push_back({.outline = outline,
                             .start = {-1 + 0.8 * static_cast<double>(arena.objects.size()), 1, 0},
                             .mass_kg = 0.5,
                             .friction_N = 0.6});
  }
  World world(arena, kRvr, std::vector<Pose>{{0, 0, 0}, {-0.5, 0, 1}, {0.5, 0, 2}, {0, -1, 3}},
              ContactModel::Exact);
  double deepest = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    for (int i = 0; i < world.robots(); ++i) {
      if (tick > 0 && !rng.bernoulli(0.1)) continue;
      world.command(i, rng.bernoulli(0.7) ? Command{0.3, 0.3} : Command{-0.3, 0.3});
    }
    world.advance(static_cast<int>(1 + rng.below(10)));
    for (int i = 0; i < world.movers(); ++i) {
      deepest = std::max(deepest, depth_in_surroundings(world, i));
      for (int j = i + 1; j < world.movers(); ++j) {
        deepest = std::max(
            deepest, -gap_between(world.form(i), world.body(i), world.form(j), world.body(j)));
      }
    }
  }
  EXPECT_LT(deepest, 0.025);
  EXPECT_GT(deepest, 0.0001) << "they never met";
  RecordProperty("deepest_um", static_cast<int>(deepest * 1e6));
}

}  // namespace
}  // namespace swarmsmith
