#include "robot/runtime/control_clock.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

TimePoint at_ms(int when) {
  return TimePoint(milliseconds(when));
}

ControlClock clock_of(std::int64_t cycles = 1200) {
  return {at_ms(1000), milliseconds(100), cycles};
}

TEST(ControlClock, GivesEachCycleOnceAndNotBeforeItIsDue) {
  ControlClock clock = clock_of();
  EXPECT_EQ(clock.beat(at_ms(1000)).cycle, 0);
  EXPECT_EQ(clock.next(), at_ms(1100));
  EXPECT_EQ(clock.beat(at_ms(1099)).cycle, 0);
  const ControlClock::Beat first = clock.beat(at_ms(1103));
  EXPECT_EQ(first.cycle, 1);
  EXPECT_EQ(first.late, milliseconds(3));
  EXPECT_EQ(first.skipped, 0);
  EXPECT_EQ(clock.beat(at_ms(1104)).cycle, 0);
  EXPECT_EQ(clock.beat(at_ms(1200)).cycle, 2);
}

TEST(ControlClock, SkipsAndCountsWhatIsAPeriodLateAndNeverCatchesUp) {
  ControlClock clock = clock_of();
  clock.beat(at_ms(1100));
  const ControlClock::Beat late = clock.beat(at_ms(1299));
  EXPECT_EQ(late.cycle, 2);
  EXPECT_EQ(late.skipped, 0);
  EXPECT_EQ(late.late, milliseconds(99));
  const ControlClock::Beat later = clock.beat(at_ms(1755));
  EXPECT_EQ(later.cycle, 7);
  EXPECT_EQ(later.skipped, 4);
  EXPECT_EQ(later.late, milliseconds(55));
  EXPECT_EQ(clock.beat(at_ms(1756)).cycle, 0);
  EXPECT_EQ(clock.next(), at_ms(1800));
}

TEST(ControlClock, EndsAtItsLastCycleHoweverLateItIs) {
  ControlClock clock = clock_of(5);
  const ControlClock::Beat last = clock.beat(at_ms(9000));
  EXPECT_EQ(last.cycle, 5);
  EXPECT_EQ(last.skipped, 4);
  EXPECT_EQ(last.late, milliseconds(7500)) << "after its deadline";
  EXPECT_EQ(clock.beat(at_ms(9100)).cycle, 0);
  EXPECT_EQ(clock.last(), 5);
  EXPECT_EQ(clock_of(0).beat(at_ms(1100)).cycle, 0) << "a run without cycles";
}

TEST(ControlClock, DoesNotDrift) {
  ControlClock clock = clock_of();
  for (std::int64_t cycle = 1; cycle <= 1200; ++cycle) {
    EXPECT_EQ(clock.next(), at_ms(1000) + cycle * milliseconds(100));
    EXPECT_EQ(clock.beat(clock.next() + milliseconds(cycle % 40)).cycle, cycle);
  }
}

}  // namespace
}  // namespace swarmsmith
