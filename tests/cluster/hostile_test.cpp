// Hostile peers among the workers: the answer is that of an honest cluster, or the campaign says
// that it is not.

#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/cluster/simulated_cluster.h"
#include "tests/support/long_runs.h"

namespace swarmsmith::cluster {
namespace {

constexpr std::uint64_t kShards = 8;
#ifdef SWARMSMITH_SANITIZED
constexpr std::uint64_t kSchedulesOfAShard = 50;  // each frame's arena is mapped anew there
#else
constexpr std::uint64_t kSchedulesOfAShard = 250;
#endif

std::uint64_t schedules_of_a_shard() {
  return times(kSchedulesOfAShard, 20 * kSchedulesOfAShard);
}

std::string described(const Schedule& schedule) {
  std::string text = schedule.keys ? "with keys:" : "without keys:";
  for (const Misdeed misdeed : schedule.hostile)
    text += std::string(" ") + name_of(misdeed) + ";";
  return text;
}

/// What became of the schedules.
struct Ends {
  int right = 0;
  int stopped = 0;
  int escaped = 0;
};

void run_one(std::uint64_t seed, Ends& ends) {
  const Schedule schedule = hostile_schedule_of(seed);
  SimulatedCluster cluster(schedule);
  const std::string failure = cluster.run();
  EXPECT_EQ(failure, "") << "seed " << seed << ", " << described(schedule)
                         << " to see it alone: SWARMSMITH_CLUSTER_SEED=" << seed << " "
                         << SWARMSMITH_BIN_DIR << "/cluster_test --gtest_filter='*Hostile*'";
  if (!cluster.stopped().empty()) {
    ++ends.stopped;
  } else {
    ++(cluster.escaped() ? ends.escaped : ends.right);
  }
}

class HostileSchedules : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(HostileSchedules, GiveTheHonestAnswerOrSayThatTheyCannot) {
  Ends ends;
  if (const char* seed = std::getenv("SWARMSMITH_CLUSTER_SEED"); seed != nullptr) {
    if (GetParam() == 0) run_one(std::strtoull(seed, nullptr, 10), ends);
    return;
  }
  const std::uint64_t count = schedules_of_a_shard();
  for (std::uint64_t i = 0; i < count && !HasFailure(); ++i)
    run_one(GetParam() * count + i + 1, ends);
  std::printf(
      "  seeds from %llu: %d with the honest answer, %d stopped with a reason, %d with lies "
      "that no audit chose\n",
      static_cast<unsigned long long>(GetParam() * count + 1), ends.right, ends.stopped,
      ends.escaped);
}

INSTANTIATE_TEST_SUITE_P(Shard, HostileSchedules, ::testing::Range<std::uint64_t>(0, kShards));

class EachMisdeed : public ::testing::TestWithParam<Misdeed> {};

/// So that a peer which does nothing is not taken for one that does no harm.
TEST_P(EachMisdeed, ReallyHappens) {
  std::uint64_t acts = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatedCluster cluster({.seed = seed,
                              .faults = {.until = std::chrono::milliseconds(400)},
                              .campaign = {.seed = seed},
                              .hostile = {GetParam(), GetParam()},
                              .keys = seed % 2 == 0,
                              .audit_every = 1});
    EXPECT_EQ(cluster.run(), "") << "seed " << seed;
    acts += cluster.acts(GetParam());
  }
  EXPECT_GE(acts, 20U);
  std::printf("  %s: %llu times in 20 schedules\n", name_of(GetParam()),
              static_cast<unsigned long long>(acts));
}

INSTANTIATE_TEST_SUITE_P(Kind, EachMisdeed, ::testing::ValuesIn(kMisdeeds));

/// Forgiving is not a way around the trial: the answer is right, or cannot be had.
TEST(Hostile, AnyNumberOfForgivingsChangesNoAnswer) {
  int forgiven = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatedCluster cluster({.seed = seed,
                              .faults = {.forgivings = 10, .until = std::chrono::milliseconds(400)},
                              .campaign = {.seed = seed},
                              .hostile = {Misdeed::Lies, Misdeed::LiesLater, Misdeed::Fails},
                              .keys = seed % 2 == 0,
                              .audit_every = 1});
    EXPECT_EQ(cluster.run(), "") << "seed " << seed;
    EXPECT_FALSE(cluster.escaped()) << "seed " << seed;
    forgiven += cluster.forgiven();
  }
  EXPECT_GT(forgiven, 5);
}

/// The check itself: without audits lies come into the store, and are known as such.
TEST(Hostile, LiesThatAreNotLookedForAreSeenByTheTest) {
  std::size_t lies = 0;
  int escaped = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatedCluster cluster({.seed = seed,
                              .faults = {.until = std::chrono::milliseconds(400)},
                              .campaign = {.seed = seed},
                              .hostile = {Misdeed::Lies},
                              .keys = true,
                              .audit_every = 0});
    EXPECT_EQ(cluster.run(), "") << "seed " << seed;
    lies += cluster.lies();
    escaped += cluster.escaped() ? 1 : 0;
  }
  EXPECT_GT(lies, 100U);
  EXPECT_GT(escaped, 10);
}

}  // namespace
}  // namespace swarmsmith::cluster
