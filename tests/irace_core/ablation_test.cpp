#include "irace_core/ablation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "tests/irace_core/spaces.h"

namespace swarmsmith {
namespace {

using namespace testing;  // NOLINT: the words of spaces
using ::testing::ElementsAre;

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

/// Costs of changes on pairs; counts the runs, and keeps them in their order.
class Target {
 public:
  explicit Target(std::function<double(double, double)> cost) : cost_(std::move(cost)) {}

  AblationRuns runs() {
    return [this](std::span<const Experiment> wanted) -> Expected<std::vector<Measurement>> {
      std::vector<Measurement> found;
      for (const Experiment& run : wanted) {
        made.push_back(run);
        found.push_back(
            {.cost = cost_(static_cast<double>(run.configuration), static_cast<double>(run.pair))});
      }
      return found;
    };
  }

  std::vector<Experiment> made;

 private:
  std::function<double(double, double)> cost_;
};

Scenario five_pairs_first() {
  Scenario scenario;
  scenario.first_test = 5;
  return scenario;
}

constexpr double kRejected = std::numeric_limits<double>::infinity();

TEST(AblationStep, FullRunsAllChangesOnAllPairs) {
  // The third is far better: a race would drop the others.
  Target target([](double change, double pair) { return (change == 3 ? 0 : 100) + 0.1 * pair; });
  const auto best = best_change(five_pairs_first(), AblationType::Full, 4, 20, target.runs());
  ASSERT_TRUE(best);
  EXPECT_EQ(*best, 2U);
  EXPECT_EQ(target.made.size(), 80U);
}

TEST(AblationStep, RacingDropsWhatIsWorse) {
  Target target(
      [](double change, double pair) { return 10.0 * std::fmod(change, 3) + 0.1 * pair; });
  const auto best = best_change(five_pairs_first(), AblationType::Racing, 3, 20, target.runs());
  ASSERT_TRUE(best);
  EXPECT_EQ(*best, 2U);
  EXPECT_GE(target.made.size(), 15U);
  EXPECT_LT(target.made.size(), 40U);
  // With one change there is nothing to race.
  target.made.clear();
  EXPECT_EQ(*best_change(five_pairs_first(), AblationType::Racing, 1, 20, target.runs()), 0U);
  EXPECT_EQ(target.made.size(), 20U);
}

TEST(AblationStep, RejectedChangesAreOutOfIt) {
  Target target([](double change, double pair) {
    if (change == 1) return pair == 3 ? kRejected : 0.0;
    return change;
  });
  for (const auto type : {AblationType::Full, AblationType::Racing})
    EXPECT_EQ(*best_change(five_pairs_first(), type, 3, 10, target.runs()), 1U);
  Target nothing([](double, double) { return kRejected; });
  const auto nobody = best_change(five_pairs_first(), AblationType::Full, 3, 10, nothing.runs());
  ASSERT_TRUE(nobody);
  EXPECT_EQ(*nobody, std::nullopt);
}

TEST(AblationStep, CallsTheTargetEvaluatorAfterTheRunsOfAPair) {
  Scenario scenario = five_pairs_first();
  scenario.target_evaluator = true;
  Target target([](double change, double) { return -change; });
  EXPECT_EQ(*best_change(scenario, AblationType::Full, 2, 6, target.runs()), 1U);
  ASSERT_EQ(target.made.size(), 24U);
  for (std::size_t i = 0; i < target.made.size(); ++i)
    EXPECT_EQ(target.made[i].is_evaluation, i % 4 >= 2) << i;
}

TEST(AblationStep, PassesOnWhatFailed) {
  const AblationRuns fails = [](std::span<const Experiment>) -> Expected<std::vector<Measurement>> {
    return bad_input("said nothing", "targetRunner");
  };
  const auto best = best_change(five_pairs_first(), AblationType::Full, 2, 6, fails);
  ASSERT_FALSE(best);
  EXPECT_EQ(best.error().message, "said nothing");
}

TEST(Ablation, TheBestIsThatOfTheRanks) {
  // The mean of the first is better, its ranks are not.
  const std::vector<std::vector<double>> costs = {{0, 2, 2}, {9, 1, 1}};
  EXPECT_EQ(best_by_ranks(costs, TestType::FTest), 1U);
  EXPECT_EQ(best_by_ranks(costs, TestType::TTest), 0U);
}

}  // namespace
}  // namespace swarmsmith
