#include "sim/control/behaviours.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"

namespace swarmsmith {
namespace {

constexpr double kSpeed = 0.30;
constexpr Command kForward{kSpeed, kSpeed};

enum class Turned { No, Left, Right };

/// What Exploration decides on entry: it goes forward, and then it turns or not. tau is so large
/// that a draw of 0 has a chance of one in a million.
Turned decision(FakeSenses senses, const Flavour& flavour) {
  BehaviourMemory memory;
  Rng rng(7);
  EXPECT_EQ(act(Exploration{1'000'000}, senses, flavour, memory, rng), kForward);
  if (memory.turn_cycles_left == 0) return Turned::No;
  return memory.turn_left ? Turned::Left : Turned::Right;
}

Command steered(const Behaviour& behaviour, FakeSenses senses, const Flavour& flavour) {
  BehaviourMemory memory;
  Rng rng(7);
  const Command command = act(behaviour, senses, flavour, memory, rng);
  EXPECT_EQ(rng.drawn(), 0U) << "only Exploration draws";
  return command;
}

void expect_command(Command got, double left_mps, double right_mps) {
  EXPECT_NEAR(got.left_mps, left_mps, 1e-12);
  EXPECT_NEAR(got.right_mps, right_mps, 1e-12);
}

// --- Wheels --------------------------------------------------------------------------------------

TEST(CommandTowards, TheFarTreadRunsAtFullSpeedTheNearOneAtTheCosine) {
  expect_command(command_towards(1, 0, kSpeed), kSpeed, kSpeed);
  expect_command(command_towards(5, 0, kSpeed), kSpeed, kSpeed);
  expect_command(command_towards(3, 4, kSpeed), 0.18, kSpeed);      // left, cosine 0.6
  expect_command(command_towards(3, -4, kSpeed), kSpeed, 0.18);     // right
  expect_command(command_towards(0, 1, kSpeed), 0, kSpeed);         // 90 degrees left
  expect_command(command_towards(-3, 4, kSpeed), -0.18, kSpeed);    // behind on the left
  expect_command(command_towards(-1, 0, kSpeed), kSpeed, -kSpeed);  // straight back: spins
  expect_command(command_towards(0, 0, kSpeed), 0, 0);
  expect_command(command_towards(1e-170, -1e-170, kSpeed), 0, 0);  // its square is 0
}

// --- Stop ----------------------------------------------------------------------------------------

TEST(Stop, StandsStillAndAsksForNothing) {
  FakeSenses senses;
  BehaviourMemory memory;
  Rng rng(1);
  EXPECT_EQ(act(Stop{}, senses, watermelon(), memory, rng), (Command{0, 0}));
  EXPECT_EQ(senses.asked(), 0);
}

// --- Exploration ---------------------------------------------------------------------------------

TEST(Exploration, GoesForwardWhenNothingIsInTheWay) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(decision(FakeSenses{}, *flavour), Turned::No);
    EXPECT_EQ(decision(FakeSenses{}.obstacle(180, 0.1), *flavour), Turned::No);
    EXPECT_EQ(decision(FakeSenses{}.obstacle(135, 0.1), *flavour), Turned::No);
  }
}

TEST(Exploration, TurnsAwayFromTheSideOfTheObstacle) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_EQ(decision(FakeSenses{}.obstacle(45, 0.2), *flavour), Turned::Right);
    EXPECT_EQ(decision(FakeSenses{}.obstacle(-45, 0.2), *flavour), Turned::Left);
    EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.2), *flavour), Turned::Right);
  }
}

TEST(Exploration, FrontIs45DegreesInTheThesisAnd90InTheProgram) {
  EXPECT_EQ(decision(FakeSenses{}.obstacle(90, 0.1), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(-90, 0.1), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(90, 0.1), watermelon_argos3()), Turned::Right);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(-90, 0.1), watermelon_argos3()), Turned::Left);
}

TEST(Exploration, TheThesisHeedsTheStrongestFrontReadingTheProgramTheSum) {
  // Strongest in front: on the right. The sum points to the left, because of the side sensor.
  const auto senses = FakeSenses{}.obstacle(-45, 0.2).obstacle(45, 0.25).obstacle(90, 0.1);
  EXPECT_EQ(decision(senses, watermelon()), Turned::Left);
  EXPECT_EQ(decision(senses, watermelon_argos3()), Turned::Right);
  // A near obstacle behind draws the sum backwards; a front sensor alone is enough for the thesis.
  const auto squeezed = FakeSenses{}.obstacle(0, 0.3).obstacle(180, 0.1);
  EXPECT_EQ(decision(squeezed, watermelon()), Turned::Right);
  EXPECT_EQ(decision(squeezed, watermelon_argos3()), Turned::No);
}

TEST(Exploration, ThresholdIsAReadingOfOneTenthInTheThesisAndAnyReadingInTheProgram) {
  // (0.4 - 0.366) / 0.35 = 0.097 and (0.4 - 0.364) / 0.35 = 0.103.
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.366), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.364), watermelon()), Turned::Right);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.4), watermelon_argos3()), Turned::Right);
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.401), watermelon_argos3()), Turned::No);
}

TEST(Exploration, TheProgramIsBlindUnderFiveCentimetres) {
  const auto touching = FakeSenses{}.obstacle(0, -kNothing);
  EXPECT_EQ(decision(touching, watermelon()), Turned::Right);
  EXPECT_EQ(decision(touching, watermelon_argos3()), Turned::No);
}

TEST(Exploration, AheadIsLeftOnTheSideWithLess) {
  const auto ahead = FakeSenses{}.obstacle(0, 0.1);
  auto left_more = ahead;
  left_more.obstacle(45, 0.2).obstacle(-45, 0.3);
  EXPECT_EQ(decision(left_more, watermelon()), Turned::Right);
  auto right_more = ahead;
  right_more.obstacle(45, 0.3).obstacle(-45, 0.2);
  EXPECT_EQ(decision(right_more, watermelon()), Turned::Left);
  auto equal = ahead;
  equal.obstacle(45, 0.2).obstacle(-45, 0.2);
  EXPECT_EQ(decision(equal, watermelon()), Turned::Right);
}

TEST(Exploration, TiesGoToTheReadingNearestAheadThenToTheLeftOne) {
  // Equal on both sides: the left one counts, so away from it.
  EXPECT_EQ(decision(FakeSenses{}.obstacle(45, 0.2).obstacle(-45, 0.2), watermelon()),
            Turned::Right);
  // Equal ahead and on the right: the one ahead counts, and the right side has more: left.
  EXPECT_EQ(decision(FakeSenses{}.obstacle(0, 0.2).obstacle(-45, 0.2), watermelon()), Turned::Left);
}

TEST(Exploration, ANeighbourInFrontIsAnObstacleInTheThesisOnly) {
  // nprox = (0.55 - 0.5) / 0.275 = 0.18; at 0.53 m it is 0.07.
  const auto near = FakeSenses{}.neighbour(0.5, -30);
  EXPECT_EQ(decision(near, watermelon()), Turned::Left);
  EXPECT_EQ(decision(near, watermelon_argos3()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.neighbour(0.53, -30), watermelon()), Turned::No);
  EXPECT_EQ(decision(FakeSenses{}.neighbour(0.3, 60), watermelon()), Turned::No);
  // It competes with the sensors: 0.91 on the left against 0.57 on the right.
  EXPECT_EQ(decision(FakeSenses{}.neighbour(0.3, 20).obstacle(-45, 0.2), watermelon()),
            Turned::Right);
}

/// Frequency of the number of turning cycles that follow on the sight of an obstacle.
std::vector<int> turn_lengths(int tau, const Flavour& flavour, int runs) {
  std::vector<int> frequency(static_cast<std::size_t>(tau) + 2);
  FakeSenses senses;
  senses.obstacle(45, 0.2);
  Rng rng(3);
  for (int i = 0; i < runs; ++i) {
    BehaviourMemory memory;
    int turning = 0;
    act(Exploration{tau}, senses, flavour, memory, rng);
    while (memory.turn_cycles_left > 0) {
      EXPECT_EQ(act(Exploration{tau}, senses, flavour, memory, rng), (Command{kSpeed, -kSpeed}));
      ++turning;
    }
    EXPECT_EQ(act(Exploration{tau}, senses, flavour, memory, rng), kForward);
    ++frequency.at(static_cast<std::size_t>(turning));
  }
  return frequency;
}

TEST(Exploration, TheThesisTurnsForZeroToTauCyclesTheProgramForOneToTauLessOne) {
  const std::vector<int> thesis = turn_lengths(3, watermelon(), 40'000);
  for (std::size_t length = 0; length <= 3; ++length)
    EXPECT_NEAR(thesis[length], 10'000, 400);
  const std::vector<int> program = turn_lengths(3, watermelon_argos3(), 30'000);
  EXPECT_EQ(program[0], 0);
  EXPECT_NEAR(program[1], 20'000, 400);  // drawn 0 or 1
  EXPECT_NEAR(program[2], 10'000, 400);
  EXPECT_EQ(program[3], 0);
}

TEST(Exploration, WithTauOneTheProgramAlwaysTurnsForOneCycle) {
  EXPECT_EQ(turn_lengths(1, watermelon_argos3(), 100)[1], 100);
}

TEST(Exploration, AsksForNothingWhileItTurns) {
  FakeSenses senses;
  senses.obstacle(0, 0.1).neighbour(0.3, 0);
  BehaviourMemory memory{.turn_cycles_left = 2, .turn_left = true};
  Rng rng(1);
  EXPECT_EQ(act(Exploration{5}, senses, watermelon(), memory, rng), (Command{-kSpeed, kSpeed}));
  EXPECT_EQ(memory.turn_cycles_left, 1);
  EXPECT_EQ(senses.asked(), 0);
}

// --- Attraction ----------------------------------------------------------------------------------

TEST(Attraction, AloneItGoesStraightOn) {
  expect_command(steered(Attraction{2}, {}, watermelon()), kSpeed, kSpeed);
  expect_command(steered(Attraction{2}, {}, watermelon_argos3()), kSpeed, kSpeed);
}

TEST(Attraction, SteersTowardsANeighbour) {
  const auto senses = FakeSenses{}.neighbour(0.4, 60);
  // In the thesis the neighbour is an obstacle too, weaker: 1.2 * 3 / 0.4 against 5 * 0.545.
  expect_command(steered(Attraction{3}, senses, watermelon()), 0.15, kSpeed);
  expect_command(steered(Attraction{5}, senses, watermelon_argos3()), 0.15, kSpeed);
  expect_command(steered(Attraction{3}, FakeSenses{}.neighbour(0.6, -60), watermelon()), kSpeed,
                 0.15);
}

TEST(Attraction, WeighsTheNearerNeighbourMore) {
  // 1.2 * 2 * (1 / 0.6 ahead + 1 / 0.7 left): cosine of atan(0.6 / 0.7).
  const auto senses = FakeSenses{}.neighbour(0.6, 0).neighbour(0.7, 90);
  const double cosine = 0.7 / std::hypot(0.6, 0.7);
  expect_command(steered(Attraction{2}, senses, watermelon()), kSpeed * cosine, kSpeed);
}

TEST(Attraction, InTheProgramAlphaIsTruncatedAndDistanceIsInCentimetres) {
  const auto senses = FakeSenses{}.neighbour(0.50, 60);
  // 1.2 * 4 / 51 = 0.094 is too short, 1.2 * 5 / 51 = 0.118 is not.
  expect_command(steered(Attraction{4.99}, senses, watermelon_argos3()), kSpeed, kSpeed);
  expect_command(steered(Attraction{5.00}, senses, watermelon_argos3()), 0.15, kSpeed);
}

TEST(Attraction, AvoidsAnObstacleWithWeightFive) {
  // Alone: 1.2 ahead in the thesis, 0 in the program; the obstacle's 5 * 0.5 wins: back.
  const auto blocked = FakeSenses{}.obstacle(0, 0.225);
  expect_command(steered(Attraction{1}, blocked, watermelon()), kSpeed, -kSpeed);
  // Half way aside: (1.2, 0) - 5 * 0.5 * (0, 1) steers right at cosine 1.2 / |(1.2, 2.5)|.
  const auto beside = FakeSenses{}.obstacle(90, 0.225);
  expect_command(steered(Attraction{1}, beside, watermelon()), kSpeed,
                 kSpeed * 1.2 / std::hypot(1.2, 2.5));
  // The program adds nothing when alone: straight to the right.
  expect_command(steered(Attraction{1}, beside, watermelon_argos3()), kSpeed, 0);
}

TEST(Attraction, CountsAVeryNearNeighbourAsTenCentimetresAway) {
  // Neighbours at 90 degrees of both sides, 0.05 and 0.10 m: they cancel, and the rest is
  // too short, so straight ahead.
  const auto senses = FakeSenses{}.neighbour(0.05, 90).neighbour(0.10, -90);
  expect_command(steered(Attraction{1}, senses, watermelon()), kSpeed, kSpeed);
}

// --- Repulsion -----------------------------------------------------------------------------------

TEST(Repulsion, AloneItGoesStraightOn) {
  expect_command(steered(Repulsion{5}, {}, watermelon()), kSpeed, kSpeed);
  expect_command(steered(Repulsion{5}, {}, watermelon_argos3()), kSpeed, kSpeed);
}

TEST(Repulsion, SteersAwayFromANeighbour) {
  const auto senses = FakeSenses{}.neighbour(0.6, 60);  // away: -120 degrees, cosine -0.5
  expect_command(steered(Repulsion{1}, senses, watermelon()), kSpeed, -0.15);
  expect_command(steered(Repulsion{5}, senses, watermelon_argos3()), kSpeed, -0.15);
}

TEST(Repulsion, InTheProgramAlphaEntersTwiceAndTruncated) {
  // 2 * 2 / 39 = 0.103 is felt, 2 * 2 / 41 = 0.098 is not.
  const auto at = [](double distance_m) { return FakeSenses{}.neighbour(distance_m, 60); };
  expect_command(steered(Repulsion{2.9}, at(0.38), watermelon_argos3()), kSpeed, -0.15);
  expect_command(steered(Repulsion{2.9}, at(0.40), watermelon_argos3()), kSpeed, kSpeed);
  // 9 / 75.9: within the whole range.
  expect_command(steered(Repulsion{3.0}, at(0.749), watermelon_argos3()), kSpeed, -0.15);
}

TEST(Repulsion, HasNoGainOfAttractionsInTheThesis) {
  // -(1 / 0.6) ahead - 5 * 0.5 right: the vector (-1.667, 2.5).
  const auto senses = FakeSenses{}.neighbour(0.6, 0).obstacle(-90, 0.225);
  const double x = -1 / 0.6;
  expect_command(steered(Repulsion{1}, senses, watermelon()), kSpeed * x / std::hypot(x, 2.5),
                 kSpeed);
}

TEST(Repulsion, AnObstacleOfTheProgramCountsOneHoweverNear) {
  // k^2 / (1 + 39) = 0.625 against 5 * 1.
  const auto senses = FakeSenses{}.neighbour(0.39, 180).obstacle(90, 0.06);
  expect_command(steered(Repulsion{5}, senses, watermelon_argos3()), kSpeed,
                 kSpeed * 0.625 / std::hypot(0.625, 5));
}

// --- Sensors -------------------------------------------------------------------------------------

TEST(Behaviour, AsksOnlyForTheSensorsItNeeds) {
  const auto after = [](const Behaviour& behaviour, const Flavour& flavour) {
    FakeSenses senses;
    senses.light_from(0, 500).neighbour(0.5, 10);
    BehaviourMemory memory;
    Rng rng(1);
    act(behaviour, senses, flavour, memory, rng);
    EXPECT_EQ(senses.ground_asked, 0);
    EXPECT_EQ(senses.time_asked, 0) << "turns are counted in cycles";
    return senses;
  };
  for (const Flavour* flavour : flavours_for(kRvrModel)) {
    SCOPED_TRACE(flavour->name);
    const bool obstacles = flavour->obstacles.neighbours_as_obstacles;
    const FakeSenses exploring = after(Exploration{5}, *flavour);
    EXPECT_EQ(exploring.proximity_asked, 1);
    EXPECT_EQ(exploring.neighbours_asked, obstacles ? 1 : 0);
    EXPECT_EQ(exploring.light_asked, 0);
    for (const Behaviour& social : {Behaviour(Attraction{2}), Behaviour(Repulsion{2})}) {
      const FakeSenses senses = after(social, *flavour);
      EXPECT_EQ(senses.proximity_asked, 1);
      EXPECT_GT(senses.neighbours_asked, 0);
      EXPECT_EQ(senses.light_asked, 0);
    }
  }
  for (const Behaviour& lit : {Behaviour(Phototaxis{}), Behaviour(AntiPhototaxis{})}) {
    const FakeSenses senses = after(lit, chocolate());
    EXPECT_EQ(senses.light_asked, 1);
    EXPECT_EQ(senses.proximity_asked, 1);
    EXPECT_EQ(senses.neighbours_asked, 0);
  }
}

// --- Values --------------------------------------------------------------------------------------

TEST(Behaviour, IsMadeFromItsModuleAndParameters) {
  for (const Behaviour& behaviour :
       {Behaviour(Exploration{12}), Behaviour(Stop{}), Behaviour(Phototaxis{}),
        Behaviour(AntiPhototaxis{}), Behaviour(Attraction{1.5}), Behaviour(Repulsion{4.25})}) {
    EXPECT_EQ(make_behaviour(module_of(behaviour), parameters_of(behaviour)), behaviour);
  }
}

TEST(Behaviour, IsNotMadeFromAConditionOrTooFewParameters) {
  const std::vector<double> one = {0.5};
  EXPECT_THROW(make_behaviour(Module::BlackFloor, one), std::invalid_argument);
  EXPECT_THROW(make_behaviour(Module::Stop, one), std::invalid_argument);
  EXPECT_THROW(make_behaviour(Module::Phototaxis, one), std::invalid_argument);
  EXPECT_THROW(make_behaviour(Module::Exploration, {}), std::invalid_argument);
}

}  // namespace
}  // namespace swarmsmith
