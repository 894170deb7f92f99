#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/behaviours/steering.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"

// What the modules of the e-puck's flavours do with readings, against the laws of the e-puck facts.

namespace swarmsmith {
namespace {

const Flavour& named(const std::string& name) {
  return **find_flavour(name);
}

/// Readings of proximity in [0, 1] in place of distances.
FakeSenses nothing_near() {
  FakeSenses senses;
  senses.distances.fill(0);
  return senses;
}

Command command_of(const Behaviour& behaviour, FakeSenses senses, const Flavour& flavour) {
  BehaviourMemory memory;
  Rng rng(1);
  return act(behaviour, senses, flavour, memory, rng);
}

void expect_towards(const Command& command, double x, double y, double least_inner) {
  const Command wanted = command_towards(x, y, 0.12, least_inner);
  EXPECT_NEAR(command.left_mps, wanted.left_mps, 1e-12);
  EXPECT_NEAR(command.right_mps, wanted.right_mps, 1e-12);
}

TEST(EPuckFlavours, AttractionIsTheSumOverGapsInCentimetresLessSixTimesTheObstacles) {
  FakeSenses senses = nothing_near();
  senses.neighbour(0.1, 90);   // 3.4: between the bodies
  senses.distances[1] = 0.05;  // ahead
  // 4.4: alpha is truncated to 2; A = 2 / (1 + 10) to the left; P = (0.05, 0).
  expect_towards(command_of(Attraction{2.9}, senses, named("chocolate-epuck")), -0.3, 2.0 / 11, -1);
  // 4.4: alpha enters twice, obstacles five times.
  expect_towards(command_of(Repulsion{2.9}, senses, named("chocolate-epuck")), -0.25, -4.0 / 11,
                 -1);
  // 5.3: once, and the slower wheel is bounded.
  expect_towards(command_of(Repulsion{2.9}, senses, named("maple-epuck")), -0.25, -2.0 / 11, -0.5);
}

TEST(EPuckFlavours, WithoutARobotInSightTheyGoStraightOn) {
  for (const Flavour* flavour : flavours_for("rm1.2")) {
    for (const Behaviour& behaviour : {Behaviour(Attraction{3}), Behaviour(Repulsion{3}),
                                       Behaviour(Phototaxis{}), Behaviour(AntiPhototaxis{})})
      EXPECT_EQ(command_of(behaviour, nothing_near(), *flavour), (Command{0.12, 0.12}));
  }
}

TEST(EPuckFlavours, LightIsAllOrNothing) {
  FakeSenses senses = nothing_near();
  senses.lux.fill(0);
  senses.lux[7] = 0.3;  // left
  expect_towards(command_of(Phototaxis{}, senses, named("chocolate-epuck")), 0, 1, -1);
  expect_towards(command_of(AntiPhototaxis{}, senses, named("chocolate-epuck")), 0, -1, -1);
  senses.distances[1] = 0.1;  // P = (0.1, 0): the light counts 1, whatever its reading
  expect_towards(command_of(Phototaxis{}, senses, named("chocolate-epuck")), -0.5, 1, -1);
  expect_towards(command_of(Phototaxis{}, senses, named("chocolate-epuck-2018")), -0.5, 0.3, -0.5);
  senses.distances[1] = 0;
  senses.lux[7] = 0.2;  // 4.1: more than 0.2
  expect_towards(command_of(Phototaxis{}, senses, named("chocolate-epuck")), 1, 0, -1);
  expect_towards(command_of(Phototaxis{}, senses, named("chocolate-epuck-2018")), 0, 0.2, -0.5);
}

TEST(EPuckFlavours, ObstaclesAreCutToOneOrNot) {
  FakeSenses senses = nothing_near();
  senses.distances = {1, 1, 1, 0, 0, 0, 0, 0};
  senses.neighbour(0, 180);  // touching: A = 5 behind
  senses.neighbour(0, 90);
  const double sum = 1 + 2 * std::sqrt(0.5);
  ASSERT_GT(sum, 1);
  expect_towards(command_of(Attraction{5}, senses, named("chocolate-epuck")), -5 - 6, 5, -1);
  expect_towards(command_of(Attraction{5}, senses, named("chocolate-epuck-2018")), -5 - 6 * sum, 5,
                 -0.5);
}

TEST(EPuckFlavours, ExplorationTurnsAsItsTriggerSays) {
  const auto turns = [](const FakeSenses& senses, const Flavour& flavour) {
    FakeSenses again = senses;
    BehaviourMemory memory;
    Rng rng(3);
    EXPECT_EQ(act(Exploration{50}, again, flavour, memory, rng), (Command{0.12, 0.12}));
    return memory.turn_cycles_left == 0 ? 0 : memory.turn_left ? 1 : -1;
  };
  FakeSenses senses = nothing_near();
  senses.distances[0] = 0.2;  // ahead on the left
  EXPECT_EQ(turns(senses, named("chocolate-epuck")), -1);
  EXPECT_EQ(turns(senses, named("maple-epuck")), 0) << "5.3: from 0.5 on";
  EXPECT_EQ(turns(senses, named("chocolate-epuck-2018")), -1);
  senses.distances[3] = 0.5;  // and more on the right
  EXPECT_EQ(turns(senses, named("chocolate-epuck-2018")), 1) << "the side is that of the sum";
  senses.distances[0] = 0.09;
  EXPECT_EQ(turns(senses, named("chocolate-epuck-2018")), 0) << "no reading of the front";
  EXPECT_EQ(turns(senses, named("chocolate-epuck")), 1) << "the sum has both";
}

TEST(EPuckFlavours, CountsWereOnceSubtractedWithoutASign) {
  const auto probability = [](const Condition& condition, int neighbours, const std::string& name) {
    FakeSenses senses = nothing_near();
    for (int i = 0; i < neighbours; ++i)
      senses.neighbour(0.2, 10 * i);
    return enabling_probability(condition, senses, named(name));
  };
  const Condition count = NeighbourCount{.eta = 20, .xi = 2};
  const Condition inverted = InvertedNeighbourCount{.eta = 20, .xi = 2};
  EXPECT_NEAR(probability(count, 3, "chocolate-epuck"), 1, 1e-8);
  EXPECT_EQ(probability(count, 3, "maple-epuck"), 0);
  EXPECT_EQ(probability(inverted, 3, "maple-epuck"), 1);
  EXPECT_EQ(probability(count, 2, "maple-epuck"), 0.5);
  EXPECT_EQ(probability(NeighbourCount{.eta = 0, .xi = 2}, 3, "maple-epuck"), 0.5);
}

}  // namespace
}  // namespace swarmsmith
