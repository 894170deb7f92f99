#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <set>

#include "tests/coordinator/design/target_campaigns.h"
#include "tests/support/long_runs.h"

namespace swarmsmith {
namespace {

/// Whatever the options, a design that is left at any place and taken up again ends as one that was
/// not; nothing is asked for twice, nor more than the budget where only what counts is asked for.
TEST(RandomTargetDesign, GoesOnAsIfNothingHadHappened) {
  Rng rng(4711);
  std::map<DesignState, int> ends;
  const int rounds = times(40, 120);
  for (int round = 0; round < rounds; ++round) {
    const TargetChoices options = random_options(rng);
    SCOPED_TRACE("round " + std::to_string(round) + "\n" + options.race + options.simulator);
    const Campaign campaign = campaign_with(options.race, options.simulator, options.test);
    if (HasFailure()) return;
    std::vector<DesignPlan> designs = plans(campaign);
    const bool single = rng.bernoulli(0.5);
    designs.front().scenario.one_task_at_a_time = single;
    const double rejects = rng.bernoulli(0.4) ? rng.uniform(0, 0.1) : 0;
    const Answer answer = [&](const Task& task) {
      return random_target(task, options.evaluates, rejects);
    };
    expect_resumable(designs, answer, rng.split("cuts", static_cast<std::uint64_t>(round)));
    const Ran ran = undisturbed(designs, answer);
    std::set<std::string> keys;
    for (const Task& task : ran.tasks)
      EXPECT_TRUE(keys.insert(to_string(task.key)).second) << to_string(task.key) << " twice";
    const DesignStateRow last = ran.memory.only<DesignStateRow>().back();
    const auto runs = std::ranges::count_if(
        ran.tasks, [](const Task& task) { return task.key.purpose == Purpose::Race; });
    if (single || rejects == 0) {
      EXPECT_EQ(runs, last.used);
    }
    if (campaign.race.max_experiments > 0) {
      EXPECT_LE(last.used, campaign.race.max_experiments);
    }
    ++ends[last.state];
    if (HasFailure()) return;
  }
  EXPECT_GT(ends[DesignState::Finished], rounds * 2 / 3);
}

}  // namespace
}  // namespace swarmsmith
