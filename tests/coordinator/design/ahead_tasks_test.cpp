#include "coordinator/design/ahead_tasks.h"

#include <gtest/gtest.h>

#include <array>

namespace swarmsmith {
namespace {

EvaluationKey key(std::int64_t candidate, std::int64_t pair) {
  return {candidate_id({1}, candidate), Purpose::Race, pair};
}

TEST(AheadTasks, DropsOnceWhatIsOutOfTheRaceAndStillTakesItsOutcome) {
  AheadTasks ahead;
  for (std::int64_t candidate = 1; candidate <= 3; ++candidate)
    ahead.add(key(candidate, 5), 1.5);
  ahead.end_step(std::array<std::int64_t, 2>{1, 3});
  EXPECT_EQ(ahead.take_dropped(), std::vector{key(2, 5)});
  ahead.end_step(std::array<std::int64_t, 1>{1});
  EXPECT_EQ(ahead.take_dropped(), std::vector{key(3, 5)});
  EXPECT_EQ(ahead.remove(key(2, 5)), 1.5);
  EXPECT_EQ(ahead.remove(key(2, 5)), std::nullopt);
  EXPECT_EQ(ahead.outstanding().size(), 2U);
}

TEST(AheadTasks, DoesNotDropWhatIsWanted) {
  AheadTasks ahead;
  ahead.add(key(1, 5), 0);
  ahead.drop_all();
  ahead.want(key(1, 5));
  EXPECT_TRUE(ahead.take_dropped().empty());
  EXPECT_FALSE(ahead.contains(key(1, 5)));
}

TEST(AheadTasks, LooksAtEachExpectedExperimentOnceInAStep) {
  AheadTasks ahead;
  ahead.expect({{.configuration = 1, .pair = 6}}, 1);
  EXPECT_EQ(ahead.next()->configuration, 1);
  EXPECT_EQ(ahead.next(), nullptr);
  ahead.expect({{.configuration = 1, .pair = 6}, {.configuration = 1, .pair = 7}}, 2);
  EXPECT_EQ(ahead.next()->pair, 7);
  ahead.end_step({});
  EXPECT_EQ(ahead.pairs_expected(), 0);
  EXPECT_EQ(ahead.next(), nullptr);
}

}  // namespace
}  // namespace swarmsmith
