#include "irace_core/ablation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Ablation, TheBestIsThatOfTheRanks) {
  // The mean of the first is better, its ranks are not.
  const std::vector<std::vector<double>> costs = {{0, 2, 2}, {9, 1, 1}};
  EXPECT_EQ(best_by_ranks(costs, TestType::FTest), 1U);
  EXPECT_EQ(best_by_ranks(costs, TestType::TTest), 0U);
}

}  // namespace
}  // namespace swarmsmith
