#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "irace_core/internal/postselection.h"
#include "irace_core/internal/schedule.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith::irace {
namespace {

using testing::golden;

std::vector<std::map<std::string, std::int64_t>> read_formulas() {
  std::ifstream in(std::string(SWARMSMITH_TEST_DATA) + "/irace/schedule_formulas.csv");
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::int64_t>> rows;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string field;
    std::size_t column = 0;
    if (!names.empty()) rows.emplace_back();
    while (std::getline(fields, field, ',')) {
      if (rows.empty()) {
        names.push_back(field.substr(1, field.size() - 2));
      } else {
        rows.back()[names[column++]] = static_cast<std::int64_t>(std::stod(field));
      }
    }
  }
  return rows;
}

std::int64_t or_default(std::int64_t option, std::int64_t otherwise) {
  return option > 0 ? option : otherwise;
}

TEST(ScheduleGolden, FormulasGiveTheNumbersOfIrace) {
  int elitist = 0;
  int other = 0;
  for (auto& row : read_formulas()) {
    SCOPED_TRACE("nparams " + std::to_string(row["nparams"]) + " remaining " +
                 std::to_string(row["remainingBudget"]));
    const std::int64_t plain = default_count(static_cast<int>(row["nparams"]));
    EXPECT_EQ(or_default(row["opt_nbIterations"], plain), row["nbIterations"]);
    EXPECT_EQ(or_default(row["opt_minNbSurvival"], plain), row["minSurvival"]);
    const std::int64_t budget =
        row["remainingBudget"] / (row["nbIterations"] - row["indexIteration"] + 1);
    EXPECT_EQ(budget, row["currentBudget"]);
    EXPECT_EQ(race_size({.budget = budget,
                         .iteration = row["indexIteration"],
                         .mu = row["mu"],
                         .pairs_between_tests = row["eachTest"] * row["blockSize"],
                         .elites = row["nElites"],
                         .old_pairs = row["nOldInstances"],
                         .new_pairs = row["newInstances"]}),
              row["nbConfigurations"]);
    EXPECT_EQ(minimum_budget({.elitist = row["elitist"] != 0,
                              .iterations = row["nbIterations"],
                              .min_survival = row["minSurvival"],
                              .mu = row["mu"],
                              .pairs_between_tests = row["eachTest"] * row["blockSize"],
                              .new_pairs = row["newInstances"]}),
              row["minimumBudget"]);
    ++(row["elitist"] != 0 ? elitist : other);
  }
  EXPECT_EQ(elitist, 46);
  EXPECT_EQ(other, 54);
}

Scenario scenario_of(const nlohmann::json& options) {
  Scenario scenario;
  scenario.max_experiments = options["maxExperiments"];
  scenario.elitist_new_instances = options.value("elitistNewInstances", 1);
  scenario.mu = options.value("mu", 5);
  scenario.min_nb_survival = options.value("minNbSurvival", 0);
  scenario.nb_iterations = options.value("nbIterations", 0);
  scenario.nb_experiments_per_iteration = options.value("nbExperimentsPerIteration", 0);
  scenario.elitist = options.value("elitist", 1) == 1;
  scenario.block_size = options.value("blockSize", 1);
  scenario.deterministic = options.value("deterministic", 0) == 1;
  return scenario;
}

/// Real runs report what each race used; with that the schedule must plan the same races.
void replay(Schedule& schedule, const nlohmann::json& run) {
  std::int64_t remaining = run["options"]["maxExperiments"];
  for (const auto& iteration : run["iterations"]) {
    if (iteration["postselection"]) return;  // what would come next belongs to post-selection
    const auto& race = iteration["race"];
    const auto next = schedule.next(remaining, race["n_elites"], race["n_old_instances"]);
    ASSERT_TRUE(std::holds_alternative<RacePlan>(next)) << std::get<NoMoreRaces>(next).reason;
    const auto& plan = std::get<RacePlan>(next);
    EXPECT_EQ(plan.configurations, race["n_configurations"]);
    EXPECT_EQ(plan.budget, race["max_experiments"]);
    // Irace passes on what a race without elitism does not look at.
    const bool elitist = run["options"].value("elitist", 1) == 1;
    EXPECT_EQ(plan.new_pairs, elitist ? race["elitist_new_instances"].get<int>() : 0);
    if (!iteration["budget_calls"].empty()) {
      EXPECT_EQ(plan.iteration, iteration["budget_calls"].back()["indexIteration"]);
      EXPECT_EQ(plan.iterations, iteration["budget_calls"].back()["nbIterations"]);
    }
    remaining -= race["experiments_used"].get<std::int64_t>();
  }
}

TEST(ScheduleGolden, PlansTheRacesThatIracePlanned) {
  int races = 0;
  int errors = 0;
  for (const auto& run : golden("schedule_runs.json")) {
    const auto& options = run["options"];
    SCOPED_TRACE("seed " + run["seed"].dump());
    Schedule schedule(scenario_of(options), run["nparams"].get<int>());
    EXPECT_EQ(schedule.iterations(), run["nbIterations"]);
    EXPECT_EQ(schedule.min_survival(), run["minSurvival"]);
    EXPECT_EQ(schedule.minimum_budget(), run["minimumBudget"]);
    EXPECT_EQ(run.contains("error"), schedule.minimum_budget() > options["maxExperiments"]);
    if (run.contains("error")) {
      ++errors;
      continue;
    }
    replay(schedule, run);
    races += static_cast<int>(run["iterations"].size());
  }
  EXPECT_EQ(errors, 7);
  EXPECT_GT(races, 60);
}

/// A run that ended for want of budget ends here too.
TEST(ScheduleGolden, EndsWhereIraceEnded) {
  int ends = 0;
  for (const auto& run : golden("schedule_runs.json")) {
    const auto& options = run["options"];
    if (run.contains("error")) continue;
    Schedule schedule(scenario_of(options), run["nparams"].get<int>());
    const auto& iterations = run["iterations"];
    std::size_t count = iterations.size();
    std::int64_t final_elites = run["final_elites"];
    if (iterations.back()["postselection"]) {
      --count;
      final_elites = std::min(iterations[count - 1]["race"]["n_alive_end"].get<std::int64_t>(),
                              schedule.min_survival());
    }
    std::int64_t remaining = options["maxExperiments"];
    for (std::size_t i = 0; i < count; ++i) {
      const auto& race = iterations[i]["race"];
      (void)schedule.next(remaining, race["n_elites"], race["n_old_instances"]);
      remaining -= race["experiments_used"].get<std::int64_t>();
    }
    SCOPED_TRACE("seed " + run["seed"].dump());
    const auto next =
        schedule.next(remaining, final_elites, iterations[count - 1]["race"]["n_result_rows"]);
    EXPECT_TRUE(std::holds_alternative<NoMoreRaces>(next));
    ++ends;
  }
  EXPECT_GT(ends, 10);
}

/// Real runs: the elites miss nothing, and so do all who were alive at the end.
TEST(ScheduleGolden, PostselectionChoosesAsManyAsIrace) {
  int compared = 0;
  for (const auto& run : golden("schedule_runs.json")) {
    if (!run.contains("iterations") || !run["iterations"].back()["postselection"]) continue;
    SCOPED_TRACE("seed " + run["seed"].dump());
    const auto& race = run["iterations"].back()["race"];
    const auto& last = run["iterations"][run["iterations"].size() - 2]["race"];
    const std::int64_t complete = last["n_alive_end"];
    const std::int64_t step = run["options"].value("blockSize", 1);
    const std::int64_t budget = race["max_experiments"];
    if (budget / step > complete) continue;  // then what the others have seen matters
    const auto chosen = choose_for_postselection(
        std::vector<PostselectionCandidate>(static_cast<std::size_t>(complete), {1, 0}), budget,
        step);
    EXPECT_EQ(chosen.size(), race["n_configurations"].get<std::size_t>());
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

}  // namespace
}  // namespace swarmsmith::irace
