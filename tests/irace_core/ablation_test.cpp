#include "irace_core/ablation.h"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace testing;  // NOLINT: the words of spaces
using ::testing::Pair;

Configuration of(std::vector<double> values) {
  Configuration configuration(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    configuration.set(i, values[i]);
  return configuration;
}
const double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(Ablation, ChangesOneParameterAtATimeWithThoseThatDependOnIt) {
  const ParameterSpace space =
      space_of({make_categorical("mode", {"slow", "fast"}), make_integer("x", 0, 100),
                active_when(make_real("y", 0, 1), equals("mode", "fast")),
                active_when(make_real("z", 0, 1), equals("mode", "slow"))});
  const Configuration source = of({0, 60, kNone, 0.5});
  const Configuration target = of({1, 30, 0.25, kNone});
  const auto open = differences(source, target);
  EXPECT_THAT(open, ElementsAre(0, 1, 2, 3));
  const auto changes = ablation_changes(space, source, target, open);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].configuration, of({1, 60, 0.25, kNone}));
  EXPECT_THAT(changes[0].changed, ElementsAre(0, 2, 3));
  EXPECT_EQ(changes[1].configuration, of({0, 30, kNone, 0.5}));
  EXPECT_THAT(changes[1].changed, ElementsAre(1));
}

TEST(Ablation, WhatIsForbiddenOrDoesNotFitComesLater) {
  const ParameterSpace space = space_of({make_integer("x", 0, 9), make_integer("y", 0, 9)},
                                        {call(Operation::Less, name("x"), name("y"))});
  const auto changes =
      ablation_changes(space, of({5, 4}), of({3, 2}), std::vector<std::size_t>{0, 1});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].configuration, of({5, 2}));
}

TEST(Ablation, SaysWhatMadeAConfigurationOfTheOneBefore) {
  const ParameterSpace space =
      space_of({active_when(make_real("y", 0, 1), equals("mode", "fast")),
                make_categorical("mode", {"slow", "fast"}), make_integer("x", 0, 100)});
  const Configuration source = of({kNone, 0, 60});
  const Configuration target = of({0.25, 1, 30});
  const Configuration fast = of({0.25, 1, 60});
  EXPECT_THAT(change_between(space, source, fast, target), ElementsAre(1, 0));
  EXPECT_THAT(change_between(space, fast, target, target), ElementsAre(2));
  // All that was left comes in the order of the parameters.
  EXPECT_THAT(change_between(space, source, target, target), ElementsAre(0, 1, 2));
}

/// A way between two configurations of numbers from 0 to 9, driven to its end.
class Driven {
 public:
  using Cost = std::function<double(const Configuration&, const Experiment&)>;

  Driven(Scenario scenario, const std::vector<double>& source, const std::vector<double>& target,
         const Cost& cost) {
    std::vector<Parameter> parameters;
    for (std::size_t i = 0; i < source.size(); ++i)
      parameters.push_back(make_integer("p" + std::to_string(i), 0, 9));
    scenario.max_experiments = most_ablation_runs(of(source), of(target), scenario.ablation_pairs);
    search =
        start_ablation(space_of(std::move(parameters)), scenario, {of(source), of(target)}).value();
    keep_events();
    while (!search->finished()) {
      std::vector<Measurement> measured;
      for (const Experiment& run : search->wanted()) {
        made.push_back(run);
        measured.push_back({.cost = cost(search->configuration(run.configuration), run)});
      }
      search->tell(measured);
      keep_events();
    }
  }

  template <class Event>
  std::vector<Event> only() const {
    std::vector<Event> found;
    for (const RaceEvent& event : events) {
      if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
    }
    return found;
  }

  /// The elites of each iteration, by what they are.
  std::vector<Configuration> way() const {
    std::vector<Configuration> found;
    for (const IterationEnded& ended : only<IterationEnded>()) {
      if (ended.elites.size() == 1)
        found.push_back(search->configuration(ended.elites.front().configuration));
    }
    return found;
  }

  std::unique_ptr<Search> search;
  std::vector<Experiment> made;
  std::vector<RaceEvent> events;

 private:
  void keep_events() {
    for (RaceEvent& event : search->take_events())
      events.push_back(std::move(event));
  }
};

Scenario on_pairs(std::int64_t pairs, AblationType type = AblationType::Full) {
  Scenario scenario;
  scenario.n_instances = 6;
  scenario.seed = 42;
  scenario.ablation = type;
  scenario.ablation_pairs = pairs;
  return scenario;
}

constexpr double kRejected = std::numeric_limits<double>::infinity();

/// The second parameter matters most, then the third.
double weighed(const Configuration& values, const Experiment& run) {
  return 100 - values[0] - 20 * values[1] - 5 * values[2] + 0.1 * static_cast<double>(run.pair);
}

TEST(AblationWay, FullRunsAllChangesOnAllPairs) {
  const Driven way(on_pairs(20), {0, 0, 0}, {1, 1, 1}, weighed);
  EXPECT_THAT(way.way(), ElementsAre(of({0, 0, 0}), of({0, 1, 0}), of({0, 1, 1})));
  EXPECT_EQ(way.made.size(), (1U + 3U + 2U + 1U) * 20U);
  EXPECT_EQ(way.search->experiments_used(), 140);
  EXPECT_EQ(way.search->elites().size(), 4U) << "all that are on the way";
  EXPECT_EQ(way.search->configuration(way.search->elites().front().configuration), of({1, 1, 1}));
  EXPECT_EQ(way.only<IterationStarted>().size(), 4U);
  EXPECT_EQ(way.only<RaceStep>().back().experiments_used, 140);
  // Each comes from the one that was kept before.
  const auto sampled = way.only<ConfigurationSampled>();
  EXPECT_EQ(sampled.front().parent, 0);
  EXPECT_EQ(sampled.back().parent, way.search->elites()[1].configuration);
}

/// Those that `swarmsmith irace --ablation` drew before it was a campaign, with seed 42.
TEST(AblationWay, ThePairsAreThoseOfEarlierVersions) {
  const Driven way(on_pairs(5), {0, 0, 0}, {1, 1, 1}, weighed);
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (std::size_t i = 0; i < 5; ++i)
    pairs.emplace_back(way.made[i].instance, way.made[i].seed);
  EXPECT_THAT(pairs, ElementsAre(Pair(3, 25277278), Pair(6, 1595559908), Pair(2, 1900644715),
                                 Pair(1, 1004693638), Pair(4, 958447822)));
}

double weighed_alone(const Configuration& values, const Experiment& run) {
  return 9 - values[0] + 0.1 * static_cast<double>(run.pair);
}

TEST(AblationWay, RacingDropsWhatIsWorse) {
  const auto cost = [](const Configuration& values, const Experiment& run) {
    return 10 * values[0] + 5 * values[1] - values[2] + 0.1 * static_cast<double>(run.pair % 3);
  };
  const Driven way(on_pairs(20, AblationType::Racing), {0, 0, 0}, {1, 1, 1}, cost);
  EXPECT_THAT(way.way(), ElementsAre(of({0, 0, 0}), of({0, 0, 1}), of({0, 1, 1})));
  EXPECT_GE(way.made.size(), 7U * 5U);
  EXPECT_LT(way.made.size(), 7U * 20U);
  // With one change there is nothing to race.
  const Driven last(on_pairs(20, AblationType::Racing), {0}, {1}, weighed_alone);
  EXPECT_EQ(last.made.size(), 40U);
}

TEST(AblationWay, RejectedChangesAreOutOfIt) {
  const auto cost = [](const Configuration& values, const Experiment& run) {
    if (values == of({1, 0, 0})) return run.pair == 3 ? kRejected : 0.0;
    return 10 + values[2];
  };
  for (const auto type : {AblationType::Full, AblationType::Racing}) {
    const Driven way(on_pairs(10, type), {0, 0, 0}, {1, 1, 1}, cost);
    EXPECT_EQ(way.way()[1], of({0, 1, 0}));
  }
  const auto none = [](const Configuration& values, const Experiment&) {
    return values[0] + values[1] == 1 ? kRejected : 1.0;
  };
  const Driven way(on_pairs(5), {0, 0}, {1, 1}, none);
  ASSERT_TRUE(way.search->failure());
  EXPECT_EQ(way.search->failure()->message, "the target rejected all changes of step 1");
  // Source and target are what was asked for.
  const Driven ends(on_pairs(5), {0}, {1}, [](const Configuration& values, const Experiment&) {
    return values[0] == 0 ? kRejected : 1.0;
  });
  EXPECT_FALSE(ends.search->failure());
  EXPECT_EQ(ends.search->elites().front().configuration, 2);
  EXPECT_EQ(ends.search->elites().back().mean, 0);
}

/// All pairs of a configuration are wanted at once, so it has costs on the pairs after its
/// rejection.
TEST(AblationWay, CostsAfterARejectionDoNotCount) {
  const Driven way(on_pairs(5), {0}, {1}, [](const Configuration& values, const Experiment& run) {
    return values[0] == 0 && run.pair == 3 ? kRejected : 10.0;
  });
  const Elite& source = way.search->elites().back();
  EXPECT_EQ(source.configuration, 1);
  EXPECT_EQ(source.n, 2);
  EXPECT_EQ(way.search->experiments_used(), 3 + 5);
}

TEST(AblationWay, CallsTheTargetEvaluatorAfterTheRunsOfAPair) {
  Scenario scenario = on_pairs(6);
  scenario.target_evaluator = true;
  const Driven way(scenario, {0, 0}, {1, 1}, weighed_alone);
  ASSERT_EQ(way.made.size(), 2U * (1U + 2U + 1U) * 6U);
  std::int64_t last = 0;
  for (std::size_t i = 12; i < 36; ++i) {
    const Experiment& run = way.made[i];
    EXPECT_EQ(run.is_evaluation, i % 4 >= 2) << i;
    // Tasks are counted through all steps.
    if (run.is_evaluation) {
      EXPECT_EQ(run.task, 6 + run.pair) << i;
    }
    last = std::max(last, run.task);
  }
  EXPECT_EQ(last, 12);
}

TEST(AblationWay, TheBestIsThatOfTheRanks) {
  // The mean of the source is better, its ranks are not.
  const auto cost = [](const Configuration& values, const Experiment& run) {
    return values[0] == 0 ? (run.pair == 1 ? 0.0 : 2.0) : (run.pair == 1 ? 9.0 : 1.0);
  };
  Scenario scenario = on_pairs(3);
  EXPECT_EQ(Driven(scenario, {0}, {1}, cost).search->elites().front().configuration, 2);
  scenario.test_type = TestType::TTest;
  EXPECT_EQ(Driven(scenario, {0}, {1}, cost).search->elites().front().configuration, 1);
}

TEST(AblationWay, RefusesWhatCannotBe) {
  const ParameterSpace space = space_of({make_integer("x", 0, 9), make_integer("y", 0, 9)});
  Scenario scenario = on_pairs(5);
  scenario.max_experiments = 19;
  EXPECT_THAT(complaint_of(start_ablation(space, scenario, {of({0, 0}), of({1, 1})})),
              HasSubstr("at least 20"));
  scenario.max_experiments = 20;
  EXPECT_TRUE(start_ablation(space, scenario, {of({0, 0}), of({1, 1})}));
  EXPECT_FALSE(start_ablation(space, scenario, {of({0, 0}), of({0, 0})}));
  EXPECT_FALSE(start_ablation(space, scenario, {of({0, 0})}));
  EXPECT_FALSE(start_ablation(space, scenario, {of({0, 0}), of({1, 10})}));
  scenario.deterministic = true;
  scenario.ablation_pairs = 7;
  scenario.max_experiments = 100;
  EXPECT_FALSE(start_ablation(space, scenario, {of({0, 0}), of({1, 1})}));
}

}  // namespace
}  // namespace swarmsmith
