#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "irace_core/internal/race.h"
#include "irace_core/internal/rounding.h"
#include "tests/irace_core/costs.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith::irace {
namespace {

using testing::as_matrix;
using testing::as_vector;
using testing::golden;
using testing::kNotEvaluated;
using testing::number_or;

/// The pairs in the order of irace without shuffling: new, past, unused.
std::vector<std::int64_t> order_of_pairs(std::int64_t next, std::int64_t fresh, std::int64_t all) {
  std::vector<std::int64_t> order;
  for (std::int64_t pair = next; pair < next + fresh; ++pair)
    order.push_back(pair);
  for (std::int64_t pair = 1; pair < next; ++pair)
    order.push_back(pair);
  for (std::int64_t pair = next + fresh; pair <= all; ++pair)
    order.push_back(pair);
  return order;
}

TestType test_type(const std::string& name) {
  const std::map<std::string, TestType> types = {{"F-test", TestType::FTest},
                                                 {"t-test", TestType::TTest},
                                                 {"t-test-bonferroni", TestType::TTestBonferroni},
                                                 {"t-test-holm", TestType::TTestHolm}};
  return types.at(name);
}

Race make_race(const nlohmann::json& trace, std::int64_t pairs) {
  const std::int64_t block = trace["block_size"];
  const std::int64_t next = trace["next_instance"];
  RaceSettings settings{.test_type = test_type(trace["test_type"]),
                        .first_test = trace["first_test"].get<std::int64_t>() * block,
                        .pairs_between_tests = trace["each_test"].get<std::int64_t>() * block,
                        .elitist_limit = trace["elitist_limit"],
                        .confidence = trace["confidence"],
                        .min_survival = trace["min_survival"],
                        .max_experiments = trace["max_experiments"],
                        .pairs = {},
                        .new_pairs = next == 1 ? 0 : trace["elitist_new_instances"].get<int>(),
                        .past_pairs = next - 1};
  settings.pairs = order_of_pairs(next, settings.new_pairs, pairs);
  std::vector<Contestant> contestants;
  for (const std::int64_t id : as_vector<std::int64_t>(trace["config_ids"])) {
    contestants.push_back({id, {}});
  }
  if (next > 1) {
    const auto past = as_matrix(trace["elite_data"], kNotEvaluated);
    for (std::size_t elite = 0; elite < trace["n_elites"]; ++elite) {
      for (const auto& row : past)
        contestants[elite].past.push_back(row[elite]);
    }
  }
  return Race(std::move(settings), std::move(contestants));
}

/// Answers everything that the race asks for from the table of costs (null is a rejection).
void run(Race& race, const std::vector<std::vector<double>>& costs) {
  while (!race.finished()) {
    std::vector<double> answers;
    for (const RaceRun& wanted : race.wanted()) {
      answers.push_back(
          costs[static_cast<std::size_t>(race.pair_of(wanted.task) - 1)][wanted.column]);
    }
    race.tell(testing::measured(answers));
  }
}

/// All numbers in a text, in order: the facts of a reason to stop.
std::vector<int> numbers_in(const std::string& text) {
  std::vector<int> numbers;
  bool within = false;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (digit && !within) numbers.push_back(0);
    if (digit) numbers.back() = numbers.back() * 10 + (c - '0');
    within = digit;
  }
  return numbers;
}

/// Reported values are rounded for display; null is "not available".
void expect_displayed(const std::optional<double>& ours, const nlohmann::json& theirs,
                      double precision) {
  ASSERT_EQ(ours.has_value(), !theirs.is_null());
  if (!ours) return;
  EXPECT_NEAR(*ours, theirs.get<double>(), precision / 2 + 1e-12);
}

void expect_same_step(const RaceStep& step, const nlohmann::json& task) {
  EXPECT_EQ(std::string(1, step.marker), task["symbol"].get<std::string>());
  EXPECT_EQ(step.pair, task["instance"]);
  EXPECT_EQ(step.alive_after, task["alive"]);
  EXPECT_EQ(step.best, task["best_id"]);
  EXPECT_NEAR(step.mean_best, task["mean_best"], 1e-9);
  EXPECT_EQ(step.experiments_used, task["experiments"]);
  expect_displayed(step.spearman_rho, task["rho"], 0.01);
  expect_displayed(step.kendall_w, task["kendall_w"], 0.01);
  expect_displayed(step.qvar, task["qvar"], 0.0001);
}

void expect_same_end(const Race& race, const nlohmann::json& trace) {
  EXPECT_EQ(race.used(), trace["experiments_used"]);
  const std::string stop = trace["stop"];
  if (stop.find("all instances") == std::string::npos) {
    EXPECT_EQ(numbers_in(race.stop_reason()), numbers_in(stop)) << race.stop_reason();
  }
  std::vector<std::int64_t> ids;
  std::vector<double> ranks;
  for (const Race::Survivor& survivor : race.survivors()) {
    ids.push_back(race.contestant(survivor.column).id);
    ranks.push_back(survivor.rank);
  }
  EXPECT_EQ(ids, as_vector<std::int64_t>(trace["final_ids"]));
  EXPECT_EQ(ranks, as_vector<double>(trace["final_ranks"]));
  std::vector<std::int64_t> rejected;
  for (std::size_t column = 0; column < race.size(); ++column) {
    if (race.is_rejected(column)) rejected.push_back(race.contestant(column).id);
  }
  const bool any = trace.contains("rejected_ids");
  EXPECT_EQ(rejected,
            any ? as_vector<std::int64_t>(trace["rejected_ids"]) : std::vector<std::int64_t>{});
}

TEST(RaceGolden, TakesTheStepsThatIraceTakes) {
  int compared = 0;
  for (const auto& trace : golden("race_traces.json")) {
    SCOPED_TRACE("race " + trace["id"].dump());
    const auto costs = as_matrix(trace["costs"], std::numeric_limits<double>::infinity());
    Race race = make_race(trace, static_cast<std::int64_t>(costs.size()));
    run(race, costs);
    const std::vector<RaceStep> steps = race.take_steps();
    ASSERT_EQ(steps.size(), trace["tasks"].size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      SCOPED_TRACE("task " + std::to_string(i + 1));
      expect_same_step(steps[i], trace["tasks"][i]);
    }
    expect_same_end(race, trace);
    ++compared;
  }
  EXPECT_EQ(compared, 32);
}

}  // namespace
}  // namespace swarmsmith::irace
