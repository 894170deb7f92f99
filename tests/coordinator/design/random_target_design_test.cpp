#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <set>

#include "tests/coordinator/design/target_campaigns.h"

namespace swarmsmith {
namespace {

/// Lines of [race] and [simulator] that can be mixed freely.
struct RandomOptions {
  std::string race;
  std::string simulator;
  std::string test;
  bool evaluates = false;
};

RandomOptions random_options(Rng& rng) {
  RandomOptions options;
  const auto line = [&](double chance, const std::string& text) {
    if (rng.bernoulli(chance)) options.race += text + "\n";
  };
  const bool elitist = rng.bernoulli(0.75);
  const bool timed = elitist && rng.bernoulli(0.4);
  if (!elitist) options.race += "elitist = false\n";
  options.race += timed ? "max_time = " + std::to_string(rng.uniform_int(1500, 3000)) + "\n"
                        : "max_experiments = " + std::to_string(rng.uniform_int(420, 600)) + "\n";
  // Capping needs elites, and times of the target.
  const bool bounded = rng.bernoulli(0.5);
  if (bounded) options.race += "bound_max = 12\n";
  if (bounded && elitist) line(timed ? 0.3 : 0.5, "capping = true");
  line(0.3, "bound_type = \"instance\"");
  const auto shape = rng.below(4);
  if (shape == 1) options.race += "block_size = 3\nfirst_test = 2\nmu = 6\n";
  if (shape == 2) options.race += "deterministic = true\nfirst_test = 2\n";
  if (shape == 3) options.race += "each_test = 2\nfirst_test = 4\n";
  line(0.2, "soft_restart_threshold = 0.2");
  line(0.3, "postselection = false");
  line(0.3, "test_type = \"t-test-holm\"");
  line(0.4, "test_nb_elites = 3");
  line(0.4, "test_iteration_elites = true");
  options.evaluates = rng.bernoulli(0.3);
  if (options.evaluates) options.simulator = "evaluator = \"./e\"\n";
  if (rng.bernoulli(0.5)) options.test = "test = [\"t1\", \"t2\"]\n";
  return options;
}

/// A target that stops at its bound, and rejects some of what it is given.
Outcome random_target(const Task& task, bool evaluates, double rejects) {
  Outcome outcome = evaluates ? judged(task) : honest(task);
  if (task.bound > 0) outcome.time = std::min(outcome.time, task.bound);
  Rng rng(static_cast<std::uint64_t>(number_of(task.key.candidate) * 1'009 + task.key.pair));
  const bool has_cost = !evaluates || task.key.purpose == Purpose::Evaluator;
  if (!has_cost || !rng.bernoulli(rejects)) return outcome;
  outcome.status = EvaluationStatus::Rejected;
  outcome.score = 0;
  return outcome;
}

/// Whatever the options, a design that is left at any place and taken up again ends as one that was
/// not; nothing is asked for twice, nor more than the budget where only what counts is asked for.
TEST(RandomTargetDesign, GoesOnAsIfNothingHadHappened) {
  Rng rng(4711);
  std::map<DesignState, int> ends;
  for (int round = 0; round < 120; ++round) {
    const RandomOptions options = random_options(rng);
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
  EXPECT_GT(ends[DesignState::Finished], 80);
}

}  // namespace
}  // namespace swarmsmith
