#include "sim/control/machine_control.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/control/machine_text.h"
#include "tests/sim/control/fake_senses.h"

namespace swarmsmith {
namespace {

constexpr Command kForward{0.3, 0.3};
constexpr Command kStill{0, 0};

Machine machine_of(std::string_view text) {
  return parse_machine(text, watermelon()).value();
}

/// Explores and stops by turns, as soon as it may.
const char* const kAlternating =
    "--nstates 2 --s0 0 --rwm0 5 --n0 1 --n0x0 0 --c0x0 5 --p0x0 1 "
    "--s1 1 --n1 1 --n1x0 0 --c1x0 5 --p1x0 1";

TEST(MachineControl, StaysAtLeastTwoCyclesAndTheCommandIsTheOldBehaviours) {
  const Machine machine = machine_of(kAlternating);
  MachineControl software(machine, watermelon(), Rng(1));
  FakeSenses senses;
  const std::array<Command, 8> commands = {kForward, kForward, kStill, kStill,
                                           kForward, kForward, kStill, kStill};
  const std::array<int, 8> states = {0, 1, 1, 0, 0, 1, 1, 0};
  ASSERT_FALSE(commands.empty());
  for (std::size_t cycle = 0; cycle < commands.size(); ++cycle) {
    EXPECT_EQ(software.step(senses), commands[cycle]) << cycle;
    EXPECT_EQ(software.state(), states[cycle]) << cycle;
  }
}

TEST(MachineControl, TestsNoConditionInTheFirstCycleOfAState) {
  const Machine machine = machine_of(
      "--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 0 --p0x0 1 --s1 1 --n1 1 --n1x0 0 --c1x0 3 "
      "--p1x0 0 --w1x0 20");
  MachineControl software(machine, watermelon(), Rng(1));
  FakeSenses senses;
  senses.floor = {0, 0, 0};
  software.step(senses);
  EXPECT_EQ(senses.ground_asked, 0);
  EXPECT_EQ(software.state(), 0);
  software.step(senses);
  EXPECT_GT(senses.ground_asked, 0);
  EXPECT_EQ(software.state(), 1);
  software.step(senses);
  EXPECT_EQ(senses.neighbours_asked, 0);
  software.step(senses);
  EXPECT_GT(senses.neighbours_asked, 0);
}

TEST(MachineControl, ReEnteringExplorationForgetsTheTurn) {
  const Machine machine = machine_of(
      "--nstates 2 --s0 0 --rwm0 100 --n0 1 --n0x0 0 --c0x0 5 --p0x0 1 "
      "--s1 1 --n1 1 --n1x0 0 --c1x0 5 --p1x0 1");
  MachineControl software(machine, watermelon_argos3(), Rng(5));
  FakeSenses senses;
  senses.obstacle(0, 0.2);
  for (int round = 0; round < 20; ++round) {
    EXPECT_EQ(software.step(senses), kForward);  // in the first cycle, always
    EXPECT_NE(software.step(senses), kForward);  // a turn, which the transition cuts off
    EXPECT_EQ(software.step(senses), kStill);
    EXPECT_EQ(software.step(senses), kStill);
  }
}

TEST(MachineControl, AFinalStateIsNeverLeft) {
  const Machine machine = machine_of("--nstates 1 --s0 1");
  MachineControl software(machine, watermelon(), Rng(1));
  FakeSenses senses;
  for (int cycle = 0; cycle < 100; ++cycle)
    software.step(senses);
  EXPECT_EQ(software.state(), 0);
  EXPECT_EQ(senses.asked(), 0);
}

/// How often each state is the first one that the machine goes to.
std::array<int, 4> first_targets(const Machine& machine, FakeSenses senses, int runs) {
  std::array<int, 4> frequency{};
  for (int run = 0; run < runs; ++run) {
    MachineControl software(machine, watermelon(), Rng(9).split("run", static_cast<unsigned>(run)));
    software.step(senses);
    software.step(senses);
    ++frequency.at(static_cast<std::size_t>(software.state()));
  }
  return frequency;
}

double chi_square(const std::array<int, 4>& observed, const std::array<double, 4>& expected) {
  double sum = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] == 0) {
      EXPECT_EQ(observed[i], 0) << i;
    } else {
      sum += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    }
  }
  return sum;
}

/// Upper 0.1 % points of chi-square with 2 and 3 degrees of freedom (any table).
constexpr double kChiSquare2 = 13.82;
constexpr double kChiSquare3 = 16.27;

TEST(MachineControl, ChoosesUniformlyAmongTheEnabledTransitions) {
  // Grey floor: transitions 0, 2 and 3 are enabled, the black one is not.
  const Machine machine = machine_of(
      "--nstates 4 --s0 1 --n0 4 --n0x0 0 --c0x0 5 --p0x0 1 --n0x1 1 --c0x1 0 --p0x1 1 "
      "--n0x2 1 --c0x2 1 --p0x2 1 --n0x3 2 --c0x3 5 --p0x3 1 --s1 1 --s2 1 --s3 1");
  const auto frequency = first_targets(machine, {}, 30'000);
  EXPECT_LT(chi_square(frequency, {0, 10'000, 10'000, 10'000}), kChiSquare2);
}

TEST(MachineControl, TheFirstEnabledOfARandomOrderWinsInDistribution) {
  // Probabilities 0.5 and 1: half of the time both are enabled and share, else the sure one wins.
  const Machine machine = machine_of(
      "--nstates 3 --s0 1 --n0 2 --n0x0 0 --c0x0 5 --p0x0 0.5 --n0x1 1 --c0x1 5 --p0x1 1 "
      "--s1 1 --s2 1");
  const auto frequency = first_targets(machine, {}, 20'000);
  EXPECT_LT(chi_square(frequency, {0, 5'000, 15'000, 0}), kChiSquare2);
}

TEST(MachineControl, ATransitionFiresWithItsProbability) {
  const Machine machine = machine_of(
      "--nstates 4 --s0 1 --n0 3 --n0x0 0 --c0x0 1 --p0x0 0.2 --n0x1 1 --c0x1 3 --p0x1 1 "
      "--w0x1 1 --n0x2 2 --c0x2 0 --p0x2 1 --s1 1 --s2 1 --s3 1");
  FakeSenses senses;  // grey floor, one neighbour: z = 0.5
  senses.neighbour(0.5, 0);
  const auto frequency = first_targets(machine, senses, 40'000);
  // Only the first: 0.1, and half of both, 0.05; the second alone: 0.4, and 0.05; none: 0.4.
  EXPECT_LT(chi_square(frequency, {16'000, 6'000, 18'000, 0}), kChiSquare3);
}

TEST(MachineControl, ManyNeighboursAreBeyondTheTableAndStillCount) {
  const Machine machine =
      machine_of("--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 3 --p0x0 10 --w0x0 20 --s1 1");
  FakeSenses senses;
  for (int i = 0; i < 20; ++i)
    senses.neighbour(0.5, 18.0 * i);
  EXPECT_EQ(first_targets(machine, senses, 100)[1], 100);
}

TEST(MachineControl, EachCycleLooksAtTheFloorThatIsThere) {
  // Black leads on, and nothing else; what a floor gave before is not an answer for another one.
  const Machine machine = machine_of(
      "--nstates 2 --s0 1 --n0 2 --n0x0 0 --c0x0 0 --p0x0 1 --n0x1 0 --c0x1 6 --p0x1 1 --l0x1 0 "
      "--s1 1 --n1 1 --n1x0 0 --c1x0 2 --p1x0 1");
  const Rgb black = {0, 0, 0};
  const Rgb white = {255, 255, 255};
  const Rgb blue = {0, 0, 255};
  const Rgb green = {0, 255, 0};
  MachineControl software(machine, watermelon(), Rng(1));
  FakeSenses senses;
  const auto state_on = [&](const Rgb& floor) {
    senses.floor = floor;
    software.step(senses);
    return software.state();
  };
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(state_on(white), 0);  // the first cycle of a state
    EXPECT_EQ(state_on(white), 0);
    EXPECT_EQ(state_on(blue), 0);
    EXPECT_EQ(state_on(white), 0);
    EXPECT_EQ(state_on(round % 2 == 0 ? black : green), 1);
    EXPECT_EQ(state_on(black), 1);
    EXPECT_EQ(state_on(black), 1);
    EXPECT_EQ(state_on(white), 0);
  }
}

TEST(MachineControl, ProbabilityZeroNeverFires) {
  const Machine machine = machine_of("--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 5 --p0x0 0 --s1 1");
  MachineControl software(machine, watermelon(), Rng(1));
  FakeSenses senses;
  for (int cycle = 0; cycle < 10'000; ++cycle)
    software.step(senses);
  EXPECT_EQ(software.state(), 0);
}

TEST(MachineControl, TheSameStreamGivesTheSameRun) {
  const Machine machine = machine_of(kAlternating);
  MachineControl one(machine, watermelon(), Rng(11));
  MachineControl other(machine, watermelon(), Rng(11));
  FakeSenses senses;
  senses.obstacle(45, 0.1);
  for (int cycle = 0; cycle < 1000; ++cycle) {
    ASSERT_EQ(one.step(senses), other.step(senses));
    ASSERT_EQ(one.state(), other.state());
  }
}

}  // namespace
}  // namespace swarmsmith
