#include "sim/assessment/internal/condition_test.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "sim/assessment/internal/checks.h"
#include "sim/control/readings.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::assessment {
namespace {

ConditionTest test_of(Module module, const Flavour& flavour, std::size_t index = 0) {
  return tests_of(*flavour.find(module), flavour).at(index);
}

struct Meaning {
  Rgb floor;
  bool black;
  bool gray;
  bool white;
};

// The table of thesis facts, section 7.
TEST(Satisfies, IsWhatTheThesisSaysOfItsFloors) {
  const std::array<Meaning, 5> meanings = {{{{0, 0, 0}, true, false, false},
                                            {{127, 127, 127}, false, true, false},
                                            {{0, 255, 0}, false, true, false},
                                            {{255, 0, 0}, false, false, false},
                                            {{255, 255, 0}, false, false, true}}};
  const FloorModel& floor = watermelon().floor;
  for (const Meaning& meaning : meanings) {
    EXPECT_EQ(satisfies(test_of(Module::BlackFloor, watermelon()), meaning.floor, floor),
              meaning.black);
    EXPECT_EQ(satisfies(test_of(Module::GrayFloor, watermelon()), meaning.floor, floor),
              meaning.gray);
    EXPECT_EQ(satisfies(test_of(Module::WhiteFloor, watermelon()), meaning.floor, floor),
              meaning.white);
  }
}

// Written twice on purpose: the two must agree on every colour.
TEST(Satisfies, AgreesWithTheControlSoftwareOnLabels) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    for (std::size_t i = 0; i < flavour->floor.labels.size(); ++i) {
      const ConditionTest test = test_of(Module::ColorDetection, *flavour, i);
      int differ = 0;
      for (int code = 0; code < 32 * 32 * 32; ++code) {
        const auto channel = [code](int shift) {
          return static_cast<std::uint8_t>((code >> shift & 31) * 8);
        };
        const Rgb color{channel(0), channel(5), channel(10)};
        const bool seen = perceived_label(color, flavour->floor) == test.label;
        differ += satisfies(test, color, flavour->floor) == seen ? 0 : 1;
      }
      EXPECT_EQ(differ, 0) << flavour->name << " " << test.floor;
    }
  }
}

TEST(ForEachCycle, TestsNothingInTheFirstCycleOfAState) {
  const Profile profile = *built_in_profile("argos3");
  const Robot robot = rvr();
  const ConditionTest test = test_of(Module::FixedProbability, watermelon());
  const Condition always = FixedProbability{1};
  const Machine machine{{{Exploration{10}, {{always, 1}}}, {Stop{}, {{always, 0}}}}};
  // Two cycles in each state: one that tests nothing, one that fires.
  std::array<int, kRobots> cycles{};
  for_each_cycle(test, machine, {watermelon(), profile, robot}, [&](const ObservedCycle& cycle) {
    const int number = cycles[static_cast<std::size_t>(cycle.robot)]++;
    ASSERT_EQ(cycle.tested, number % 2 == 1);
    ASSERT_EQ(cycle.fired, number % 2 == 1);
    ASSERT_EQ(cycle.state, number / 2 % 2);
  });
  EXPECT_EQ(cycles[0], kConditionRuns * kCycles);
}

// A condition without a test of its own: the machine must act on what the control software makes of
// the recorded readings, as often as it says.
TEST(CheckCondition, OfOtherReadingsIsThatTheMachineActsOnThem) {
  const Profile profile = *built_in_profile("argos3");
  ConditionTest test = test_of(Module::BlackFloor, watermelon());
  test.trigger = Trigger::Readings;
  const Robot robot = rvr();
  const Check check = check_condition(test, {watermelon(), profile, robot});
  EXPECT_TRUE(check.passes) << check.note;
  const std::vector<Rate> rates = rates_of(test, {watermelon(), profile, robot});
  ASSERT_EQ(rates.size(), 1U);
  EXPECT_GT(rates[0].trials, 100);
  EXPECT_NEAR(rates[0].expected, 0.3, 1e-12);
  EXPECT_LE(rates[0].low, 0.3);
  EXPECT_GE(rates[0].high, 0.3);
  // Over gray floor alone it never fires, which is not as expected.
  test.arena.patches.clear();
  EXPECT_FALSE(check_condition(test, {watermelon(), profile, robot}).passes);
}

}  // namespace
}  // namespace swarmsmith::assessment
