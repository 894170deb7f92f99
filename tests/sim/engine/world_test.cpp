#include "sim/engine/internal/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/math.h"

namespace swarmsmith {
namespace {

class Worlds : public testing::TestWithParam<ContactModel> {
 protected:
  World world_with(const std::vector<Pose>& starts) const {
    return World(dodecagon_of_the_thesis(), rvr(), starts, GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(All, Worlds, testing::Values(ContactModel::Exact, ContactModel::Box2d),
                         [](const auto& instance) {
                           return instance.param == ContactModel::Exact ? "Exact" : "Box2d";
                         });

TEST_P(Worlds, RobotsWithoutACommandStand) {
  World world = world_with({{0, 0, 1}, {0.28, 0, 0}, {1.09, 0, 0}});
  const Body before = world.body(0);
  for (int tick = 0; tick < 20; ++tick)
    world.advance(10);
  EXPECT_NEAR(world.body(0).x, before.x, 1e-6);
  EXPECT_NEAR(world.body(0).cos, before.cos, 1e-6);
  EXPECT_NEAR(world.body(2).x, 1.09, 1e-6);
}

TEST_P(Worlds, RobotsInTheOpenNeverSeeTheContactSolver) {
  World world = world_with({{0, 0.5, 0}, {-0.5, -0.5, 0}});
  for (int robot = 0; robot < 2; ++robot)
    world.command(robot, {0.3, 0.3});
  for (int tick = 0; tick < 15; ++tick)
    world.advance(10);
  EXPECT_EQ(world.solved_sub_steps(), 0);
  EXPECT_GT(world.body(0).x, 0.3);
}

TEST_P(Worlds, OnlyTheRobotsThatMayTouchAreSolved) {
  World world = world_with({{0, 0, 0}, {0.3, 0, 0}, {-0.6, 0, 0}});
  world.command(0, {0.3, 0.3});
  world.advance(10);
  EXPECT_EQ(world.solved_sub_steps(), 20);
}

TEST_P(Worlds, TimeMayBeCutAnywhereBetweenCommands) {
  // Robots with clocks of their own make the world stop at odd sub-steps.
  const std::vector<Pose> starts = {{0, 0, 0.3}, {0.6, 0.1, 2}};
  World whole = world_with(starts);
  World parts = world_with(starts);
  for (int tick = 0; tick < 5; ++tick) {
    for (World* world : {&whole, &parts}) {
      world->command(0, {0.3, tick % 2 == 0 ? 0.3 : -0.3});
      world->command(1, {-0.2, 0.3});
    }
    whole.advance(10);
    for (const int sub_steps : {3, 1, 6})
      parts.advance(sub_steps);
    for (int robot = 0; robot < 2; ++robot) {
      EXPECT_NEAR(whole.body(robot).x, parts.body(robot).x, 1e-5);
      EXPECT_NEAR(whole.body(robot).sin, parts.body(robot).sin, 1e-5);
    }
  }
}

TEST_P(Worlds, RobotsThatPressedAndThenStandComeToRest) {
  // The rest of their speeds shrinks by the same factor in each sub-step of contact. By the
  // exact solver it is below 1e-162 m/s after 10 s, where its square is 0.
  World world = world_with({{0.3, 0, 3.5}, {-0.15, 0.26, 4.9}, {-0.15, -0.26, 1.1}});
  for (int tick = 0; tick < 150; ++tick) {
    for (int robot = 0; robot < 3; ++robot)
      world.command(robot, tick < 15 ? Command{0.3, 0.3} : Command{});
    world.advance(10);
    for (int robot = 0; robot < 3; ++robot)
      ASSERT_TRUE(is_sound(world.body(robot))) << "robot " << robot << ", tick " << tick;
  }
  for (int robot = 0; robot < 3; ++robot) {
    EXPECT_NEAR(world.body(robot).vx, 0, 1e-6) << robot;
    EXPECT_NEAR(world.body(robot).vy, 0, 1e-6) << robot;
  }
}

TEST_P(Worlds, DistancesAreThoseOfNow) {
  World world = world_with({{0, 0, 0}, {0.3, 0.4, 0}});
  EXPECT_DOUBLE_EQ(world.distance2(0, 1), 0.25);
  world.command(1, {0.3, 0.3});
  for (int tick = 0; tick < 5; ++tick)
    world.advance(10);
  const double dx = world.body(1).x - world.body(0).x;
  EXPECT_NEAR(world.distance2(1, 0), dx * dx + 0.16, 1e-9);
}

}  // namespace
}  // namespace swarmsmith
