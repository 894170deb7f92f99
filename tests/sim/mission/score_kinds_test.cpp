#include <algorithm>
#include <cmath>

#include "tests/sim/mission/score_support.h"
#include "tests/support/checks.h"
#include "tests/support/score_rules.h"

// What holds for every kind in the list, at the end and summed.

namespace swarmsmith {
namespace {

class EveryKind : public ::testing::TestWithParam<ScoreRule> {};

TEST_P(EveryKind, DoesNotDependOnTheOrderOfRobotsAndObjects) {
  Scorer scorer(GetParam(), some_arena());
  Scorer turned = scorer;
  std::vector<Point> objects = {{0.1, 0}, {5, 5}};
  for (auto& robots : random_walks(300)) {
    scorer.observe(robots, objects);
    std::ranges::reverse(robots);
    std::ranges::reverse(objects);
    turned.observe(robots, objects);
    EXPECT_EQ(scorer.score(), turned.score());
  }
  EXPECT_TRUE(std::isfinite(scorer.score()));
  EXPECT_NE(scorer.score(), 0);
}

TEST_P(EveryKind, StartsAtZeroAndIsCopied) {
  Scorer scorer(GetParam(), some_arena());
  const Scorer copy = scorer;
  scorer.observe(std::vector<Point>{{0, 0}, {3, 3}}, std::vector<Point>{{0, 0}, {3, 3}});
  scorer.observe(std::vector<Point>{{1, 0}, {3, 3}}, std::vector<Point>{{1, 0}, {3, 3}});
  EXPECT_NE(scorer.score(), 0);
  EXPECT_EQ(copy.score(), 0);
  EXPECT_FALSE(std::signbit(copy.score()));
}

TEST_P(EveryKind, SaysItsNameAndIsFoundByIt) {
  const auto found = value_of(score_of_kind(kind_of(GetParam())));
  EXPECT_EQ(found.index(), GetParam().index());
  EXPECT_FALSE(fault_of(GetParam()));
  EXPECT_FALSE(score_of_kind("external"));
}

INSTANTIATE_TEST_SUITE_P(InTheList, EveryKind, ::testing::ValuesIn(rules_of_every_kind()),
                         [](const auto& rule) {
                           return std::string(kind_of(rule.param)) + std::to_string(rule.index);
                         });

}  // namespace
}  // namespace swarmsmith
