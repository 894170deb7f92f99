#include "coordinator/design/target_calls.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(TargetCalls, AreMadeOneAfterTheOther) {
  TargetCalls calls;
  for (const std::int64_t seed : {1, 2}) {
    Task call;
    call.seed = seed;
    calls.add(call);
  }
  EXPECT_EQ(calls.next()->seed, 1);
  EXPECT_FALSE(calls.next()) << "the first one is on its way";
  calls.finish();
  EXPECT_EQ(calls.next()->seed, 2);
  calls.finish();
  EXPECT_FALSE(calls.next());
}

TEST(TargetCalls, NumberTasksOfRaceAndTestsThroughEachOther) {
  TargetCalls calls;
  EXPECT_EQ(calls.pair_in_race(1), 1);
  EXPECT_EQ(calls.pair_in_race(2), 2);
  calls.begin_tests(10);
  EXPECT_EQ(calls.pair_in_tests(1), 3);
  EXPECT_EQ(calls.pair_in_tests(10), 12);
  calls.go_on();
  EXPECT_FALSE(calls.are_tests_begun());
  EXPECT_EQ(calls.pair_in_race(3), 13);
  calls.begin_tests(10);
  EXPECT_EQ(calls.pair_in_tests(1), 14);
  calls.go_on();
  EXPECT_EQ(calls.pair_in_race(4), 24);
  // Tests follow tests when the race wants nothing in between.
  calls.begin_tests(10);
  calls.go_on();
  calls.begin_tests(10);
  EXPECT_EQ(calls.pair_in_tests(1), 35);
}

}  // namespace
}  // namespace swarmsmith
