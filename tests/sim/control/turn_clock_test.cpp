#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sim/control/behaviours.h"
#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/not_empty.h"

// Turning by time (thesis eq. 7.1): T = r * 0.1 s.

namespace swarmsmith {
namespace {

Flavour timed(const Flavour& flavour) {
  return find_flavour(flavour.name, TurnClock::Seconds).value();
}

/// Time of a control cycle, by its number.
using Clock = std::function<double(int)>;

/// Commands of a robot that always has an obstacle on its left, cycle by cycle.
std::vector<Command> commands(const Flavour& flavour, const Clock& clock, int cycles) {
  FakeSenses senses;
  senses.obstacle(45, 0.2);
  BehaviourMemory memory;
  Rng rng(3);
  std::vector<Command> given;
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    senses.now_s = clock(cycle);
    given.push_back(act(Exploration{12}, senses, flavour, memory, rng));
  }
  return given;
}

TEST(TurnClock, SecondsAreCyclesWhenThePeriodIsExact) {
  double sum = 0;
  const std::vector<Clock> clocks = {
      [](int cycle) { return 0.1 * cycle; },
      [](int cycle) { return cycle / 10.0; },
      [](int cycle) { return 0.01 * (10 * cycle); },
      [](int cycle) { return 1.7e9 + 0.1 * cycle; },  // a system's clock: rounds to 2e-7 s
      [&sum](int) { return sum += 0.1; },
  };
  for (const Flavour* flavour : not_empty(flavours_for(kRvrModel))) {
    const std::vector<Command> counted = commands(*flavour, clocks[0], 1200);
    for (std::size_t i = 0; i < clocks.size(); ++i) {
      sum = 0;
      EXPECT_EQ(commands(timed(*flavour), clocks[i], 1200), counted)
          << flavour->name << ", clock " << i;
    }
  }
}

TEST(TurnClock, ACycleThatIsALittleLateOrEarlyChangesNothing) {
  const auto shaky = [](int cycle) { return 0.1 * cycle + (cycle % 3 - 1) * 0.01; };
  EXPECT_EQ(commands(timed(watermelon()), shaky, 1200), commands(watermelon(), shaky, 1200));
}

/// How many cycles a turn of `drawn` cycles has when the control period is another.
int turning_cycles(int drawn, double period_s) {
  FakeSenses senses;
  const Flavour flavour = timed(watermelon());
  // The memory that Exploration has in the cycle after it drew.
  Rng rng(1);
  BehaviourMemory memory;
  senses.obstacle(45, 0.2);
  while (memory.turn_cycles_left != drawn) {
    memory = {};
    act(Exploration{drawn}, senses, flavour, memory, rng);
  }
  int cycles = 0;
  while (true) {
    senses.now_s += period_s;
    const Command command = act(Exploration{drawn}, senses, flavour, memory, rng);
    if (command == Command{0.3, 0.3}) return cycles;
    ++cycles;
  }
}

TEST(TurnClock, SecondsTakeTheSameTimeWhateverThePeriod) {
  for (const double period_s : {0.075, 0.08, 0.09, 0.099, 0.1, 0.101, 0.11, 0.125}) {
    for (int drawn = 1; drawn <= 40; ++drawn) {
      const int cycles = turning_cycles(drawn, period_s);
      // Commands change at cycles only, so that the turn is right to a cycle.
      EXPECT_LE(std::fabs(cycles * period_s - drawn * 0.1), 0.0751)
          << drawn << " cycles of " << period_s;
    }
  }
}

TEST(TurnClock, SecondsAreOtherThanCyclesWhenTheClockDrifts) {
  EXPECT_EQ(turning_cycles(10, 0.1), 10);
  EXPECT_EQ(turning_cycles(10, 0.09), 11);   // 0.99 s
  EXPECT_EQ(turning_cycles(10, 0.08), 13);   // 1.04 s
  EXPECT_EQ(turning_cycles(30, 0.076), 40);  // 3.04 s
  EXPECT_EQ(turning_cycles(10, 0.125), 8);   // 1.00 s
  const auto quick = [](int cycle) { return 0.085 * cycle; };
  EXPECT_NE(commands(timed(watermelon()), quick, 200), commands(watermelon(), quick, 200));
}

TEST(TurnClock, ATurnOfNoCyclesIsNoneByEither) {
  // With tau 1 half of the draws are 0: forward goes on, cycle by cycle.
  FakeSenses senses;
  senses.obstacle(45, 0.2);
  const Flavour flavour = timed(watermelon());
  Rng rng(5);
  int straight = 0;
  for (int i = 0; i < 200; ++i) {
    BehaviourMemory memory;
    senses.now_s = 0;
    act(Exploration{1}, senses, flavour, memory, rng);
    if (memory.turn_cycles_left > 0) continue;
    senses.now_s = 0.1;
    EXPECT_EQ(act(Exploration{1}, senses, flavour, memory, rng), (Command{0.3, 0.3}));
    ++straight;
  }
  EXPECT_NEAR(straight, 100, 40);
}

TEST(TurnClock, WhileItTurnsOnlyTheTimeIsAsked) {
  FakeSenses senses;
  senses.obstacle(0, 0.1);
  BehaviourMemory memory{.turn_cycles_left = 3, .turn_left = true, .turn_end_s = 0.35};
  Rng rng(1);
  senses.now_s = 0.1;
  EXPECT_EQ(act(Exploration{5}, senses, timed(watermelon()), memory, rng), (Command{-0.3, 0.3}));
  EXPECT_EQ(senses.asked(), 1);
  EXPECT_EQ(senses.time_asked, 1);
}

}  // namespace
}  // namespace swarmsmith
