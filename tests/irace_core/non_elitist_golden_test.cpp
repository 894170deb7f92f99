#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "irace_core/internal/race.h"
#include "tests/irace_core/costs.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith::irace {
namespace {

using testing::as_vector;
using testing::golden;

/// A run: configuration and pair.
using Call = std::pair<std::int64_t, std::int64_t>;

RaceSettings settings_of(const nlohmann::json& json) {
  const std::map<std::string, TestType> tests = {{"F-test", TestType::FTest},
                                                 {"t-test", TestType::TTest},
                                                 {"t-test-bonferroni", TestType::TTestBonferroni},
                                                 {"t-test-holm", TestType::TTestHolm}};
  RaceSettings settings;
  settings.elitist = false;
  settings.test_type = tests.at(json["test_type"]);
  settings.first_test = json["first_test"];
  settings.pairs_between_tests = json["each_test"];
  settings.confidence = json["confidence"];
  settings.min_survival = 3;
  settings.max_experiments = json["max_experiments"];
  const std::int64_t first = json["tasks"][0]["pair"];
  for (std::int64_t pair = first; pair < first + 60; ++pair)
    settings.pairs.push_back(pair);
  return settings;
}

TEST(NonElitistGolden, TakesTheStepsThatIraceTakes) {
  int compared = 0;
  for (const auto& json : golden("non_elitist_traces.json")) {
    SCOPED_TRACE("seed " + json["seed"].dump() + " iteration " + json["iteration"].dump());
    std::map<Call, double> costs;
    for (const auto& call : json["calls"])
      costs[{call[0], call[1]}] = call[2];
    std::vector<Contestant> contestants;
    for (const std::int64_t id : as_vector<std::int64_t>(json["ids"]))
      contestants.push_back({id, {}, {}});
    Race race(settings_of(json), contestants);
    std::set<Call> asked;
    while (!race.finished()) {
      std::vector<double> answers;
      for (const RaceRun& run : race.wanted()) {
        const Call call{race.contestant(run.column).id, race.pair_of(run.task)};
        asked.insert(call);
        ASSERT_TRUE(costs.contains(call)) << "irace did not run this";
        answers.push_back(costs[call]);
      }
      race.tell(testing::measured(answers));
    }
    EXPECT_EQ(asked.size(), costs.size());
    const std::vector<RaceStep> steps = race.take_steps();
    ASSERT_EQ(steps.size(), json["tasks"].size()) << race.stop_reason();
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
    std::vector<std::int64_t> elites;
    for (const Race::Survivor& survivor : race.survivors()) {
      if (elites.size() < 3) elites.push_back(race.contestant(survivor.column).id);
    }
    EXPECT_EQ(elites, as_vector<std::int64_t>(json["elites"]));
    ++compared;
  }
  EXPECT_EQ(compared, 16);
}

}  // namespace
}  // namespace swarmsmith::irace
