#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "base/rng.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"
#include "tests/coordinator/design/memory.h"

namespace swarmsmith {
namespace {

struct Preset {
  std::string name;
  std::string options;  ///< what keeps it small
};

void PrintTo(const Preset& preset, std::ostream* out) {
  *out << preset.name;
}

std::vector<DesignPlan> plans_of(const Preset& preset) {
  const auto campaign = parse_campaign(
      "format = 1\n[campaign]\n[[mission]]\nname = \"aggregation\"\n[mission.instances]\n"
      "test = { count = 3 }\n[[method]]\nname = \"m\"\nmethod = \"" +
          preset.name + "\"\n" + preset.options + "[race]\nmax_experiments = 700\n",
      "preset.toml");
  EXPECT_TRUE(campaign);
  return plans_of(*campaign).value();
}

/// A function of control software and seed.
double score_of(const Task& task) {
  Digest digest;
  digest.add(task.machine);
  Rng rng(digest.value64());
  return 10 * rng.uniform() + rng.split("noise", static_cast<std::uint64_t>(task.seed)).normal();
}

/// Returns after how many rows each batch ends, which a store has whole or not at all.
std::vector<std::size_t> run(CampaignRunner& runner, Memory& memory) {
  std::vector<std::size_t> ends;
  const auto keep = [&] {
    for (Row& row : runner.take_rows())
      memory.rows.push_back(std::move(row));
    ends.push_back(memory.rows.size());
  };
  for (auto tasks = runner.take_tasks(); !tasks.empty(); tasks = runner.take_tasks()) {
    for (const Task& task : tasks) {
      keep();
      runner.tell(
          {.key = task.key, .measured = {.score = score_of(task), .state_digest = 1}, .worker = 1});
    }
  }
  keep();
  EXPECT_FALSE(runner.error());
  EXPECT_TRUE(runner.finished());
  return ends;
}

class ResumedPresets : public ::testing::TestWithParam<Preset> {};

INSTANTIATE_TEST_SUITE_P(
    All, ResumedPresets,
    ::testing::Values(
        Preset{"random", ""}, Preset{"vanilla", ""},
        Preset{"evostick", "[method.evolution]\npopulation = 10\nruns = 2\nfinal_runs = 5\n"},
        Preset{"cma-es", "[method.cma-es]\npopulation = 10\nruns = 2\nfinal_runs = 5\n"},
        Preset{"icepop", "[method.annealing]\nwindow = 3\nfinal_runs = 10\n"},
        Preset{"maple", "max_subtrees = 2\n"}),
    [](const auto& tested) {
      std::string name = tested.param.name;
      std::erase(name, '-');
      return name;
    });

TEST_P(ResumedPresets, HaveTheSameRowsFromEachTenthStepOn) {
  const std::vector<DesignPlan> plans = plans_of(GetParam());
  Memory whole;
  CampaignRunner undisturbed(plans, {}, {});
  const std::vector<std::size_t> ends = run(undisturbed, whole);
  int steps = 0;
  for (std::size_t i = 0; i < whole.rows.size(); ++i) {
    if (!std::holds_alternative<RaceStepRow>(whole.rows[i]) || ++steps % 10 != 0) continue;
    Memory memory;
    const auto end = static_cast<std::ptrdiff_t>(*std::ranges::upper_bound(ends, i));
    memory.rows.assign(whole.rows.begin(), whole.rows.begin() + end);
    CampaignRunner resumed(plans, by_design(memory.scores(), memory.steps(), {}), {});
    run(resumed, memory);
    const std::vector<std::string> now = memory.answer();
    const std::vector<std::string> before = whole.answer();
    std::vector<std::string> others;
    std::ranges::set_symmetric_difference(now, before, std::back_inserter(others));
    ASSERT_THAT(others, ::testing::IsEmpty()) << "from step " << steps;
  }
  EXPECT_GE(steps, 10);
}

/// While a design races, how much is too little is not known yet.
TEST(Extensions, OneThatIsTooSmallDoesNotHoldUpTheNext) {
  const std::vector<DesignPlan> plans =
      plans_of({"evostick", "[method.evolution]\npopulation = 10\nruns = 2\nfinal_runs = 5\n"});
  const auto used_after = [&](const std::vector<CommandRow>& commands, Memory& memory) {
    memory.rows.insert(memory.rows.end(), commands.begin(), commands.end());
    CampaignRunner runner(plans, by_design(memory.scores(), memory.steps(), {}), {}, commands);
    run(runner, memory);
    EXPECT_FALSE(waits_for_extension(memory.commands()));
    return memory.only<DesignStateRow>().back().used;
  };
  const CommandRow small{
      .number = 1, .kind = CommandKind::Extend, .design = {1}, .step = {}, .budget = 1};
  const CommandRow enough{
      .number = 2, .kind = CommandKind::Extend, .design = {1}, .step = {}, .budget = 300};
  Memory plain;
  Memory both;
  const std::int64_t used = used_after({small, enough}, both);
  EXPECT_EQ(used, used_after({enough}, plain));
  EXPECT_GT(used, plans.front().scenario.max_experiments + 200);
  const std::vector<CommandRow> acted = both.commands();
  ASSERT_EQ(acted.size(), 2U);
  ASSERT_TRUE(acted[0].step);
  EXPECT_EQ(acted[0].step, acted[1].step);
  std::vector<std::string> warnings;
  for (const EventRow& event : both.only<EventRow>())
    warnings.push_back(event.text);
  EXPECT_THAT(warnings, ::testing::Contains(::testing::HasSubstr("it cannot be extended: ")));
  // A third one repeats the first two after their step.
  std::vector<CommandRow> three = acted;
  three.push_back(enough);
  three.back().number = 3;
  EXPECT_GT(used_after(three, both), used + 200);
}

}  // namespace
}  // namespace swarmsmith
