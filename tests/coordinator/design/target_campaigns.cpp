#include "tests/coordinator/design/target_campaigns.h"

#include <algorithm>
#include <utility>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/design/plans.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr const char* kParameters =
    "a \"--a \" r (0, 10)\nb \"--b \" i (1, 100)\nc \"--c \" c (x, y, z)\nd \"--d \" r (0, 1)\n";

}  // namespace

Campaign campaign_with(const std::string& race, const std::string& simulator,
                       const std::string& test) {
  const std::string text = std::string(R"(format = 1
[[mission]]
name = "tuning"
  [mission.instances]
  training = ["i1", "i2", "i3"]
)") + test + R"(
[[method]]
name = "all"
parameters_text = '''
)" + kParameters + "'''\n[race]\n" +
                           race + "\n[simulator]\nkind = \"command\"\ncommand = [\"./runner\"]\n" +
                           simulator;
  return value_of(parse_campaign(text, "x.toml"));
}

std::vector<DesignPlan> plans(const Campaign& campaign) {
  auto made = plans_of(campaign);
  EXPECT_TRUE(made) << to_string(made.error());
  return *made;
}

Outcome honest(const Task& task) {
  Digest digest;
  digest.add(task.machine);
  Rng quality(digest.value64());
  Rng noise = quality.split("noise", static_cast<std::uint64_t>(task.seed + task.instance));
  const double cost = 10 * quality.uniform() + noise.uniform();
  return {.key = task.key,
          .measured = {.score = -cost, .state_digest = 7, .time = 1 + cost},
          .worker = 1};
}

std::vector<Task> run(CampaignRunner& runner, Memory& memory, Rng order, const Answer& answer,
                      std::size_t limit) {
  std::vector<Task> ready, all;
  const auto keep = [&] {
    for (Row& row : runner.take_rows())
      memory.rows.push_back(std::move(row));
  };
  while (limit > 0) {
    for (Task& task : runner.take_tasks()) {
      all.push_back(task);
      ready.push_back(std::move(task));
    }
    keep();
    if (ready.empty()) break;
    std::swap(ready[order.below(ready.size())], ready.back());
    const Task task = std::move(ready.back());
    ready.pop_back();
    runner.tell(answer(task));
    --limit;
  }
  keep();
  EXPECT_FALSE(runner.error()) << to_string(*runner.error());
  return all;
}

Outcome judged(const Task& task) {
  Outcome outcome = honest(task);
  if (task.key.purpose != Purpose::Evaluator) outcome.measured.score = 0;
  return outcome;
}

TargetChoices random_options(Rng& rng) {
  TargetChoices options;
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

Outcome random_target(const Task& task, bool evaluates, double rejects) {
  Outcome outcome = evaluates ? judged(task) : honest(task);
  if (task.bound > 0) outcome.measured.time = std::min(outcome.measured.time, task.bound);
  Rng rng(static_cast<std::uint64_t>(number_of(task.key.candidate) * 1'009 + task.key.pair));
  const bool has_cost = !evaluates || task.key.purpose == Purpose::Evaluator;
  if (!has_cost || !rng.bernoulli(rejects)) return outcome;
  outcome.status = EvaluationStatus::Rejected;
  outcome.measured.score = 0;
  return outcome;
}

Ran undisturbed(std::vector<DesignPlan> plans, const Answer& answer) {
  Ran ran;
  CampaignRunner runner(std::move(plans), {}, {});
  ran.tasks = run(runner, ran.memory, Rng(1), answer);
  EXPECT_TRUE(runner.finished());
  return ran;
}

Ran undisturbed(const Campaign& campaign, const Answer& answer) {
  return undisturbed(plans(campaign), answer);
}

void expect_resumable(const std::vector<DesignPlan>& plans, const Answer& answer, Rng rng) {
  const auto whole = undisturbed(plans, answer).memory.answer();
  Memory memory;
  for (std::uint64_t restart = 0; restart < 6; ++restart) {
    CampaignRunner runner(plans, by_design(memory.scores(), memory.steps(), {}), {});
    ASSERT_FALSE(runner.error()) << to_string(*runner.error());
    const bool last = restart == 5;
    run(runner, memory, rng.split("order", restart), answer,
        last ? ~std::size_t{0} : rng.below(150));
  }
  EXPECT_EQ(memory.answer(), whole);
}

void expect_resumable(const Campaign& campaign, const Answer& answer) {
  expect_resumable(plans(campaign), answer, Rng(3));
}

}  // namespace swarmsmith
