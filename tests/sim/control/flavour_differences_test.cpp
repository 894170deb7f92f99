#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "sim/control/readings.h"
#include "tests/sim/control/fake_senses.h"

// Thesis text (`watermelon`) against implementation (`watermelon-argos3`), row by row of the table
// in rvr-automode facts, section 9. Rows that no flavour decides, and where they are tested:
//   1 robot size, 2 arena area      the same robot and walls: tests/sim/mission/arena_test.cpp
//   13 sign of the grid score       tests/sim/mission/score_test.cpp, recorded_scores_test.cpp
//   14 ground noise, 15 ray noise   of the profile: tests/sim/engine/sensor_faults_test.cpp,
//                                   proximity_noise_test.cpp, lidar_test.cpp; that the program's
//                                   black does not bear it, row 11 and `check`'s warning
//   20 budget                       of the campaign: tests/coordinator/campaign
//   22 designs with Attraction      a count in the thesis' own tables, nothing that is built

namespace swarmsmith {
namespace {

constexpr double kSpeed = 0.30;
constexpr Command kForward{kSpeed, kSpeed};

Command steered(const Behaviour& behaviour, FakeSenses senses, const Flavour& flavour) {
  BehaviourMemory memory;
  Rng rng(7);
  return act(behaviour, senses, flavour, memory, rng);
}

enum class Turned { No, Left, Right };

/// What Exploration decides; tau is so large that a turn of 0 cycles has a chance of 1e-6.
Turned decision(FakeSenses senses, const Flavour& flavour) {
  BehaviourMemory memory;
  Rng rng(7);
  act(Exploration{1'000'000}, senses, flavour, memory, rng);
  if (memory.turn_cycles_left == 0) return Turned::No;
  return memory.turn_left ? Turned::Left : Turned::Right;
}

/// Treads towards (x, y), worked out apart from the code.
void expect_towards(double x, double y, Command got) {
  const double inner = kSpeed * x / std::hypot(x, y);
  EXPECT_NEAR(got.left_mps, y > 0 ? inner : kSpeed, 1e-12);
  EXPECT_NEAR(got.right_mps, y > 0 ? kSpeed : inner, 1e-12);
}

bool holds(const Condition& condition, Rgb floor, const Flavour& flavour) {
  FakeSenses senses;
  senses.floor = floor;
  return enabling_probability(condition, senses, flavour) > 0;
}

Rgb gray(int level) {
  const auto channel = static_cast<std::uint8_t>(level);
  return {channel, channel, channel};
}

TEST(FlavourDifferences, Row03ProximityIsAReadingInZeroToOneOrAnInverseDistance) {
  const ObstacleModel& thesis = watermelon().obstacles;
  const ObstacleModel& program = watermelon_argos3().obstacles;
  EXPECT_NEAR(obstacle_strength(0.225, thesis), 0.5, 1e-15);
  EXPECT_EQ(obstacle_strength(0.25, program), 4);
  // Closer than 5 cm: as much as there can be, or nothing.
  EXPECT_EQ(obstacle_strength(-kNothing, thesis), 1);
  EXPECT_EQ(obstacle_strength(-kNothing, program), 0);
  // The sum of 1 ahead and 1 on the left is as long as it is, or cut to 1.
  const auto corner = FakeSenses{}.obstacle(0, 0.05).obstacle(90, 0.05);
  const Vector2 plain = obstacle_vector(corner.distances, {}, thesis);
  EXPECT_NEAR(std::hypot(plain.x, plain.y), std::sqrt(2.0), 1e-12);
  const Vector2 cut = obstacle_vector(corner.distances, {}, program);
  EXPECT_NEAR(std::hypot(cut.x, cut.y), 1, 1e-12);
}

TEST(FlavourDifferences, Row04ExplorationHeedsOneFrontSensorOrTheVectorSum) {
  // At 90 degrees: no front sensor, but within +-90 degrees of the sum.
  EXPECT_EQ(decision(FakeSenses{}.obstacle(90, 0.1), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(90, 0.1), watermelon_argos3()), Turned::Right);
  // Strongest in front: the right; the sum points to the left, because of the side.
  const auto both = FakeSenses{}.obstacle(-45, 0.2).obstacle(45, 0.25).obstacle(90, 0.1);
  EXPECT_EQ(decision(both, watermelon()), Turned::Left);
  EXPECT_EQ(decision(both, watermelon_argos3()), Turned::Right);
  // Something near behind turns the sum backwards.
  const auto squeezed = FakeSenses{}.obstacle(0, 0.3).obstacle(180, 0.1);
  EXPECT_EQ(decision(squeezed, watermelon()), Turned::Right);
  EXPECT_EQ(decision(squeezed, watermelon_argos3()), Turned::No);
  // A reading of 0.1 is 0.365 m; any 1/d within 0.4 m is enough.
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.38), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.38), watermelon_argos3()), Turned::Right);
}

TEST(FlavourDifferences, Row05TurnsLastZeroToTauCyclesOrOneToTauLessOne) {
  const auto lengths = [](const Flavour& flavour) {
    std::set<int> seen;
    FakeSenses senses;
    senses.obstacle(45, 0.2);
    Rng rng(3);
    for (int i = 0; i < 500; ++i) {
      BehaviourMemory memory;
      act(Exploration{4}, senses, flavour, memory, rng);
      seen.insert(memory.turn_cycles_left);
    }
    return seen;
  };
  EXPECT_EQ(lengths(watermelon()), (std::set<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(lengths(watermelon_argos3()), (std::set<int>{1, 2, 3}));
}

TEST(FlavourDifferences, Row06NeighboursAreObstaclesOrNot) {
  const auto ahead = FakeSenses{}.neighbour(0.3, 0);
  EXPECT_EQ(decision(ahead, watermelon()), Turned::Right);
  EXPECT_EQ(decision(ahead, watermelon_argos3()), Turned::No);
  // nprox (0.55 - 0.3) / 0.275: 1.2 / 0.3 - 5 * 0.909 < 0, so back; 1.2 * 5 / 31 > 0, so on.
  EXPECT_EQ(steered(Attraction{1}, ahead, watermelon()), (Command{kSpeed, -kSpeed}));
  EXPECT_EQ(steered(Attraction{5}, ahead, watermelon_argos3()), kForward);
  // Repulsion: -(1 / 0.4125, 0) - 5 (0.5, 0) - 5 (0, 0.5), or -(25 / 42.25, 0) - 5 (0, 1).
  const auto corner = FakeSenses{}.neighbour(0.4125, 0).obstacle(90, 0.225);
  expect_towards(-1 / 0.4125 - 2.5, -2.5, steered(Repulsion{1}, corner, watermelon()));
  expect_towards(-25 / 42.25, -5, steered(Repulsion{5}, corner, watermelon_argos3()));
}

TEST(FlavourDifferences, Row07ANeighbourWeighsAlphaOverMetresOrOverOnePlusCentimetres) {
  const auto two = FakeSenses{}.neighbour(0.6, 0).neighbour(0.7, 90);
  expect_towards(1 / 0.6, 1 / 0.7, steered(Attraction{5}, two, watermelon()));
  expect_towards(1 / 61.0, 1 / 71.0, steered(Attraction{5}, two, watermelon_argos3()));
  // Hence a lone neighbour is felt everywhere, or up to 12 alpha - 1 cm: 5 / 60 * 1.2 >= 0.1.
  const auto at = [](double distance_m) { return FakeSenses{}.neighbour(distance_m, 90); };
  expect_towards(0, 1, steered(Attraction{5}, at(0.74), watermelon()));
  expect_towards(0, 1, steered(Attraction{5}, at(0.589), watermelon_argos3()));
  EXPECT_EQ(steered(Attraction{5}, at(0.591), watermelon_argos3()), kForward);
}

TEST(FlavourDifferences, Row08AloneAheadIsAPartOfTheSumOrOnlyWhatIsLeftInItsPlace) {
  const auto beside = FakeSenses{}.obstacle(90, 0.225);
  expect_towards(1.2, -2.5, steered(Attraction{1}, beside, watermelon()));
  expect_towards(0, -5, steered(Attraction{1}, beside, watermelon_argos3()));
  expect_towards(1, -2.5, steered(Repulsion{1}, beside, watermelon()));
  expect_towards(0, -5, steered(Repulsion{1}, beside, watermelon_argos3()));
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(steered(Attraction{1}, {}, *flavour), kForward);
    EXPECT_EQ(steered(Repulsion{1}, {}, *flavour), kForward);
  }
}

TEST(FlavourDifferences, Row09AttractionHasTheSameGainsAndARealOrATruncatedAlpha) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(flavour->neighbours.attraction_gain, 1.2);
    EXPECT_EQ(flavour->steering.obstacle_gain, 5);
  }
  const auto senses = FakeSenses{}.neighbour(0.6, 0).obstacle(90, 0.225);
  expect_towards(1.2 * 4.75 / 0.6, -2.5, steered(Attraction{4.75}, senses, watermelon()));
  expect_towards(1.2 * 4 / 61, -5, steered(Attraction{4.75}, senses, watermelon_argos3()));
}

TEST(FlavourDifferences, Row10RepulsionHasAlphaOnceOrTruncatedAndTwice) {
  const auto senses = FakeSenses{}.neighbour(0.6, 180).obstacle(90, 0.225);
  expect_towards(4.75 / 0.6, -2.5, steered(Repulsion{4.75}, senses, watermelon()));
  expect_towards(16 / 61.0, -5, steered(Repulsion{4.75}, senses, watermelon_argos3()));
}

TEST(FlavourDifferences, Row11FloorThresholdsAreFractionsOfOneOrGreyLevelsOf255) {
  const Flavour& thesis = watermelon();
  const Flavour& program = watermelon_argos3();
  // Black: below 0.05 (12.75), or at most 0.10 of 255.
  EXPECT_TRUE(holds(BlackFloor{1}, gray(12), thesis));
  EXPECT_FALSE(holds(BlackFloor{1}, gray(13), thesis));
  EXPECT_TRUE(holds(BlackFloor{1}, gray(0), program));
  EXPECT_FALSE(holds(BlackFloor{1}, gray(1), program));
  // Grey: 0.5 +- 0.13 (94.35 to 160.65), or between 0.1 and 160.
  EXPECT_FALSE(holds(GrayFloor{1}, gray(94), thesis));
  EXPECT_TRUE(holds(GrayFloor{1}, gray(160), thesis));
  EXPECT_TRUE(holds(GrayFloor{1}, gray(1), program));
  EXPECT_FALSE(holds(GrayFloor{1}, gray(160), program));
  // Red is grey to the program alone.
  EXPECT_FALSE(holds(GrayFloor{1}, {255, 0, 0}, thesis));
  EXPECT_TRUE(holds(GrayFloor{1}, {255, 0, 0}, program));
  // White: above 0.78 (198.9), or from 220 on.
  EXPECT_TRUE(holds(WhiteFloor{1}, gray(199), thesis));
  EXPECT_FALSE(holds(WhiteFloor{1}, gray(219), program));
  EXPECT_TRUE(holds(WhiteFloor{1}, gray(220), program));
}

TEST(FlavourDifferences, Row12ColoursAreAHueOnACircleOrAHueOnALineAndASaturation) {
  const ColorDetection red{1, ColorLabel::Red};
  // A grey floor with a little noise: any hue, hardly any saturation.
  EXPECT_TRUE(holds(red, {128, 127, 127}, watermelon()));
  EXPECT_FALSE(holds(red, {128, 127, 127}, watermelon_argos3()));
  // Hue 345.9 degrees.
  EXPECT_TRUE(holds(red, {255, 0, 60}, watermelon()));
  EXPECT_FALSE(holds(red, {255, 0, 60}, watermelon_argos3()));
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_TRUE(holds(red, {255, 0, 0}, *flavour));
    EXPECT_FALSE(holds(red, {127, 127, 127}, *flavour));
  }
}

TEST(FlavourDifferences, Row16NeighboursAreNearerThan075MetresInBoth) {
  // The sensors leave the others out (tests/sim/engine/robot_senses_test.cpp); a flavour heeds
  // everyone it gets.
  EXPECT_EQ(kNeighbourRange_m, 0.75);
  FakeSenses senses;
  senses.neighbour(0.749, 90);
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(enabling_probability(NeighbourCount{.eta = 3, .xi = 1}, senses, *flavour), 0.5);
    expect_towards(0, -1, steered(Repulsion{5}, senses, *flavour));
  }
}

TEST(FlavourDifferences, Row17XiIsSearchedFromZeroOrFromOneToTen) {
  for (const Module module : {Module::NeighbourCount, Module::InvertedNeighbourCount}) {
    const ParameterSpec& thesis = watermelon().find(module)->parameters.at(0);
    const ParameterSpec& program = watermelon_argos3().find(module)->parameters.at(0);
    EXPECT_EQ(thesis.name, "xi");
    EXPECT_EQ(thesis.low, 0);
    EXPECT_EQ(program.low, 1);
    EXPECT_EQ(thesis.high, 10);
    EXPECT_EQ(program.high, 10);
  }
}

TEST(FlavourDifferences, Row18SpeedAndRangeAreThoseOfTheRunsInBoth) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(flavour->speed_mps, 0.30);
    EXPECT_EQ(flavour->obstacles.far_m, 0.4);
    EXPECT_EQ(obstacle_strength(0.401, flavour->obstacles), 0);
  }
}

TEST(FlavourDifferences, Row19TurnsAreCountedInCyclesInBothUnlessAMethodSaysSeconds) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(flavour->exploration.turn_clock, TurnClock::Cycles);
    const Flavour timed = find_flavour(flavour->name, TurnClock::Seconds).value();
    // A turn of 3 cycles, and a clock that goes half as fast as it should.
    FakeSenses senses;
    BehaviourMemory counted{.turn_cycles_left = 3};
    BehaviourMemory measured{.turn_cycles_left = 3, .turn_end_s = 0.35};
    Rng rng(1);
    int cycles_counted = 0;
    int cycles_measured = 0;
    for (int cycle = 1; cycle <= 10; ++cycle) {
      senses.now_s = 0.05 * cycle;
      cycles_counted += act(Exploration{5}, senses, *flavour, counted, rng) != kForward;
      cycles_measured += act(Exploration{5}, senses, timed, measured, rng) != kForward;
    }
    EXPECT_EQ(cycles_counted, 3);
    EXPECT_EQ(cycles_measured, 6);
  }
}

TEST(FlavourDifferences, Row21ADestinationIsAnIndexIntoTheOtherStatesInBoth) {
  const char* const text =
      "--nstates 3 --s0 1 --s1 1 --n1 2 --n1x0 0 --c1x0 5 --p1x0 1 --n1x1 1 --c1x1 5 --p1x1 1 "
      "--s2 1";
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    const Machine machine = parse_machine(text, *flavour).value();
    EXPECT_EQ(machine.states[1].transitions[0].target, 0);
    EXPECT_EQ(machine.states[1].transitions[1].target, 2);
    EXPECT_FALSE(
        parse_machine("--nstates 2 --s0 1 --n0 1 --n0x0 1 --c0x0 5 --p0x0 1 --s1 1", *flavour)
            .has_value())
        << "at most NumStates - 2";
  }
}

TEST(FlavourDifferences, AreAllThatThereIs) {
  // What the rows above do not name is the same.
  Flavour thesis = watermelon();
  const Flavour& program = watermelon_argos3();
  EXPECT_EQ(thesis.behaviours, program.behaviours);
  EXPECT_EQ(thesis.floor.labels, program.floor.labels);
  EXPECT_EQ(thesis.floor.hue_tolerance_deg, program.floor.hue_tolerance_deg);
  EXPECT_EQ(thesis.exploration.threshold, program.exploration.threshold);
  EXPECT_EQ(thesis.light, program.light);
  thesis.steering.forward_by_default = program.steering.forward_by_default;  // row 8
  EXPECT_EQ(thesis.steering, program.steering);
  thesis.exploration.trigger = program.exploration.trigger;  // row 4
  thesis.exploration.front_slope = program.exploration.front_slope;
  thesis.exploration.turn_length = program.exploration.turn_length;  // row 5
  EXPECT_EQ(thesis.exploration, program.exploration);
  thesis.obstacles.reading = program.obstacles.reading;  // row 3
  thesis.obstacles.longest_sum = program.obstacles.longest_sum;
  thesis.obstacles.neighbours_as_obstacles = program.obstacles.neighbours_as_obstacles;  // row 6
  EXPECT_EQ(thesis.obstacles, program.obstacles);
  thesis.neighbours.per_metre = program.neighbours.per_metre;  // row 7
  thesis.neighbours.offset = program.neighbours.offset;
  thesis.neighbours.shortest_m = program.neighbours.shortest_m;
  thesis.neighbours.alpha_truncated = program.neighbours.alpha_truncated;  // row 9
  thesis.neighbours.repulsion_power = program.neighbours.repulsion_power;  // row 10
  EXPECT_EQ(thesis.neighbours, program.neighbours);
}

}  // namespace
}  // namespace swarmsmith
