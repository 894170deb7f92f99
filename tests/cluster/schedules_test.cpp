#include <gtest/gtest.h>
#include <cstdlib>
#include <string>

#include "tests/cluster/simulated_cluster.h"

namespace swarmsmith::cluster {
namespace {

constexpr std::uint64_t kShards = 8;
constexpr std::uint64_t kSchedulesOfAShard = 1000;

class Schedules : public ::testing::TestWithParam<std::uint64_t> {};

void expect_fine(std::uint64_t seed) {
  SimulatedCluster cluster(schedule_of(seed));
  const std::string failure = cluster.run();
  EXPECT_EQ(failure, "") << "seed " << seed << "; to see it alone: SWARMSMITH_CLUSTER_SEED=" << seed
                         << " " << SWARMSMITH_BIN_DIR << "/cluster_test";
}

TEST_P(Schedules, EndWithTheAnswerOfAnUndisturbedRun) {
  if (const char* seed = std::getenv("SWARMSMITH_CLUSTER_SEED"); seed != nullptr) {
    if (GetParam() == 0) expect_fine(std::strtoull(seed, nullptr, 10));
    return;
  }
  for (std::uint64_t i = 0; i < kSchedulesOfAShard && !HasFailure(); ++i) {
    expect_fine(GetParam() * kSchedulesOfAShard + i + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Shard, Schedules, ::testing::Range<std::uint64_t>(0, kShards));

TEST(SimulatedCluster, DoesTheSameForTheSameSeed) {
  SimulatedCluster one(schedule_of(7));
  SimulatedCluster other(schedule_of(7));
  EXPECT_EQ(one.run(), other.run());
  EXPECT_EQ(one.events(), other.events());
}

TEST(SimulatedCluster, NeedsFewEventsWithoutFaults) {
  SimulatedCluster cluster({.seed = 1, .faults = {}, .campaign = {}});
  EXPECT_EQ(cluster.run(), "");
  EXPECT_LT(cluster.events(), 2000U);
}

TEST(SimulatedCluster, RejectsWhatKillsItsWorkersThreeTimesAlone) {
  SimulatedCluster cluster({.seed = 1, .faults = {}, .campaign = {.killing = true}});
  EXPECT_EQ(cluster.run(), "");
  // Once among others, three times alone.
  EXPECT_EQ(cluster.crashes(), 4);
}

}  // namespace
}  // namespace swarmsmith::cluster
