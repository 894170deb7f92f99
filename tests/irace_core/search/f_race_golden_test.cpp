#include <gmock/gmock.h>

#include <map>

#include "tests/irace_core/golden.h"
#include "tests/irace_core/search/played.h"

// The search f-race beside R's irace with one iteration, no elitism and 200 configurations
// (tests/golden/irace/record_non_elitist.R): the costs of R's run by configuration and pair, every
// step, and the winner.

namespace swarmsmith {
namespace {

using testing::as_vector;
using testing::golden;

/// A run: configuration and pair.
using Call = std::pair<std::int64_t, std::int64_t>;

std::unique_ptr<Search> search_of(const nlohmann::json& json) {
  Scenario scenario;
  scenario.max_experiments = json["max_experiments"];
  scenario.first_test = json["first_test"];
  scenario.each_test = json["each_test"];
  scenario.confidence = json["confidence"];
  scenario.test_type = json["test_type"] == "t-test" ? TestType::TTest : TestType::FTest;
  SearchOptions options = options_of(SearchKind::FRace);
  std::get<FRaceOptions>(options).configurations = 200;
  return start_search(weights_space(2), scenario, options).value();
}

TEST(FRaceGolden, TakesTheStepsThatIraceTakesWithOneIteration) {
  int until_one_is_left = 0;
  int until_the_budget_ends = 0;
  for (const auto& json : golden("f_race_traces.json")) {
    SCOPED_TRACE("seed " + json["seed"].dump());
    std::map<Call, double> costs;
    for (const auto& call : json["calls"])
      costs[{call[0], call[1]}] = call[2];
    const auto search = search_of(json);
    const Played played = play(*search, [&](const Configuration&, const Experiment& wanted) {
      const auto found = costs.find({wanted.configuration, wanted.pair});
      if (found != costs.end()) return found->second;
      ADD_FAILURE() << "irace did not run " << wanted.configuration << " on " << wanted.pair;
      return 0.0;
    });
    EXPECT_EQ(played.asked, static_cast<std::int64_t>(costs.size()));
    const auto steps = only<RaceStep>(played.events);
    ASSERT_EQ(steps.size(), json["tasks"].size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto& task = json["tasks"][i];
      SCOPED_TRACE("task " + std::to_string(i + 1));
      EXPECT_EQ(std::string(1, steps[i].marker), task["symbol"].get<std::string>());
      EXPECT_EQ(steps[i].pair, task["pair"]);
      EXPECT_EQ(steps[i].alive_after, task["alive"]);
      EXPECT_EQ(steps[i].best, task["best"]);
      EXPECT_NEAR(steps[i].mean_best, task["mean_best"], 1e-8);
      EXPECT_EQ(steps[i].experiments_used, task["experiments"]);
    }
    ASSERT_FALSE(played.elites.empty());
    EXPECT_EQ(played.elites.front().configuration, as_vector<std::int64_t>(json["elites"]).front());
    (steps.back().alive_after == 1 ? until_one_is_left : until_the_budget_ends) += 1;
  }
  EXPECT_EQ(until_one_is_left, 3);
  EXPECT_EQ(until_the_budget_ends, 1);
}

}  // namespace
}  // namespace swarmsmith
