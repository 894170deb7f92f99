#include <gtest/gtest.h>
#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/cluster/simulated_cluster.h"
#include "tests/support/long_runs.h"

namespace swarmsmith::cluster {
namespace {

constexpr std::uint64_t kShards = 8;
#ifdef SWARMSMITH_SANITIZED
constexpr std::uint64_t kSchedulesOfAShard = 100;  // each frame's arena is mapped anew there
#else
constexpr std::uint64_t kSchedulesOfAShard = 500;
#endif

std::uint64_t schedules_of_a_shard() {
  return times(kSchedulesOfAShard, 10 * kSchedulesOfAShard);
}

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
  const std::uint64_t count = schedules_of_a_shard();
  for (std::uint64_t i = 0; i < count && !HasFailure(); ++i)
    expect_fine(GetParam() * count + i + 1);
}

INSTANTIATE_TEST_SUITE_P(Shard, Schedules, ::testing::Range<std::uint64_t>(0, kShards));

class Presets : public ::testing::TestWithParam<PresetBudget> {};

INSTANTIATE_TEST_SUITE_P(All, Presets, ::testing::ValuesIn(kPresetBudgets), [](const auto& tested) {
  std::string name(tested.param.preset);
  std::erase(name, '-');
  return name;
});

Schedule with_preset(Schedule schedule, const PresetBudget& preset) {
  const auto put = [&](CampaignShape& shape) {
    shape.preset = preset.preset;
    shape.budget += preset.budget - CampaignShape{}.budget;
    shape.designs = std::min(shape.designs, 2);
  };
  put(schedule.campaign);
  if (schedule.other) put(*schedule.other);
  return schedule;
}

TEST_P(Presets, EndWithTheAnswerOfAnUndisturbedRun) {
  const std::uint64_t count = schedules_of_a_shard() / 10;
  for (std::uint64_t seed = 1; seed <= count && !HasFailure(); ++seed) {
    EXPECT_EQ(SimulatedCluster(with_preset(schedule_of(seed), GetParam())).run(), "")
        << "seed " << seed;
  }
}

TEST_P(Presets, GiveTheHonestAnswerAmongStrangersOrSayThatTheyCannot) {
  const std::uint64_t count = schedules_of_a_shard() / 20;
  for (std::uint64_t seed = 1; seed <= count && !HasFailure(); ++seed) {
    EXPECT_EQ(SimulatedCluster(with_preset(hostile_schedule_of(seed), GetParam())).run(), "")
        << "seed " << seed;
  }
}

TEST_P(Presets, ReachTheirLastIterationAndUseMostOfTheBudget) {
  CampaignShape shape{.designs = 1, .preset = std::string(GetParam().preset)};
  shape.budget = GetParam().budget;
  const SimulatedDisk disk = undisturbed(shape);
  ASSERT_EQ(disk.design_states().size(), 1U);
  const DesignStateRow design = disk.design_states().front();
  EXPECT_EQ(design.state, DesignState::Finished);
  EXPECT_LE(design.used, shape.budget);
  // An F-race may be over early.
  EXPECT_TRUE(GetParam().preset == "vanilla" || 2 * design.used > shape.budget);
}

TEST(SimulatedCluster, DoesTheSameForTheSameSeed) {
  SimulatedCluster one(schedule_of(7));
  SimulatedCluster other(schedule_of(7));
  EXPECT_EQ(one.run(), other.run());
  EXPECT_EQ(one.events(), other.events());
}

TEST(SimulatedCluster, FindsACoordinatorThatClosesItsStoresBesideSqlite) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    Schedule schedule = schedule_of(seed);
    schedule.closes_beside = true;
    schedule.faults.coordinator_crashes = 6;
    schedule.faults.visits = 60;
    schedule.faults.until = std::chrono::seconds(4);
    const std::string failure = SimulatedCluster(schedule).run();
    EXPECT_TRUE(failure.empty() || failure.ends_with(" is lost")) << seed << ": " << failure;
    if (!failure.empty()) ++found;
  }
  EXPECT_GT(found, 0);
}

TEST(SimulatedCluster, NeedsFewEventsWithoutFaults) {
  SimulatedCluster cluster({.seed = 1, .faults = {}, .campaign = {}});
  EXPECT_EQ(cluster.run(), "");
  EXPECT_LT(cluster.events(), 2000U);
  EXPECT_GT(cluster.audited(), 0U);
}

TEST(SimulatedCluster, CountsNoWorkerAsLostThatWasToldToEnd) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SimulatedCluster cluster({.seed = seed,
                              .faults = {.worker_drains = 20,
                                         .early_drains = 10,
                                         .slow_commit = 0.05,
                                         .until = std::chrono::seconds(3)},
                              .campaign = {.seed = seed}});
    EXPECT_EQ(cluster.run(), "") << seed;
    EXPECT_EQ(cluster.counters().lost_workers, 0U) << seed;
  }
}

TEST(SimulatedCluster, IsNotHeldUpByASlowWorker) {
  Duration normal{0};
  Duration slow{0};
  std::uint64_t copies = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const bool has_slow : {false, true}) {
      SimulatedCluster cluster({.seed = seed, .campaign = {.seed = seed}, .slow_worker = has_slow});
      EXPECT_EQ(cluster.run(), "") << seed;
      (has_slow ? slow : normal) += cluster.took();
      if (has_slow) copies += cluster.counters().copies;
    }
  }
  EXPECT_GT(copies, 50U);
  // Without second copies it is more than ten times as long.
  EXPECT_LT(slow, 4 * normal);
}

TEST(SimulatedCluster, LooksAheadAndSharesThePoolAmongCampaigns) {
  std::uint64_t ahead = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SimulatedCluster cluster({.seed = seed,
                              .campaign = {.seed = seed, .designs = 3},
                              .other = CampaignShape{.seed = seed + 100, .designs = 2}});
    EXPECT_EQ(cluster.run(), "") << seed;
    ahead += cluster.counters().ahead;
  }
  EXPECT_GT(ahead, 100U);
}

TEST(SimulatedCluster, RejectsWhatKillsAWorkerAloneAndTheRefereeToo) {
  int with_one = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatedCluster cluster(
        {.seed = seed, .faults = {}, .campaign = {.seed = seed, .killing = true}});
    EXPECT_EQ(cluster.run(), "") << seed;
    if (cluster.killers() != 1) continue;
    // Once among others, perhaps once more as a second copy, once alone; or, while none has
    // proved itself, six times.
    EXPECT_GE(cluster.crashes(), 2) << seed;
    EXPECT_LE(cluster.crashes(), 8) << seed;
    ++with_one;
  }
  EXPECT_GT(with_one, 0);
}

TEST(SimulatedCluster, RacesForSeveralIterationsAndDropsCandidates) {
  const SimulatedDisk disk = undisturbed({});
  const auto design_lines = [&](std::string_view beginning) {
    return std::ranges::count_if(
        disk.answer(), [&](const std::string& line) { return line.starts_with(beginning); });
  };
  EXPECT_TRUE(disk.finished());
  EXPECT_GE(disk.scores().size(), 80U);
  EXPECT_GE(design_lines("iteration:"), 4);
  EXPECT_GE(design_lines("elimination:"), 4);
}

}  // namespace
}  // namespace swarmsmith::cluster
