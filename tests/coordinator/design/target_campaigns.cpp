#include "tests/coordinator/design/target_campaigns.h"

#include <gtest/gtest.h>
#include <utility>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/design/plans.h"

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
  auto campaign = parse_campaign(text, "x.toml");
  if (campaign) return *campaign;
  for (const Error& error : campaign.error())
    ADD_FAILURE() << to_string(error);
  return {};
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
  return {.key = task.key, .score = -cost, .state_digest = 7, .worker = 1, .time = 1 + cost};
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
  if (task.key.purpose != Purpose::Evaluator) outcome.score = 0;
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
