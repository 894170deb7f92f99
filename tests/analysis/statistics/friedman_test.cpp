#include "analysis/statistics/friedman.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmsmith {
namespace {

TEST(Friedman, TheLargestValueHasRankOne) {
  const FriedmanTest test = friedman_test({{9, 5, 1}, {8, 8, 2}});
  EXPECT_EQ(test.mean_ranks, (std::vector<double>{1.25, 1.75, 3}));
  EXPECT_EQ(test.degrees, 2U);
}

TEST(Friedman, OfUnanimousBlocksIsItsLargestValue) {
  const FriedmanTest test = friedman_test({{3, 2, 1}, {30, 20, 10}, {6, 5, 4}, {9, 8, 7}});
  EXPECT_DOUBLE_EQ(test.statistic, 8);  // b (k - 1)
  EXPECT_NEAR(*test.p_value, std::exp(-4), 1e-12);
  EXPECT_EQ(*test.half_width, 0);
  EXPECT_TRUE(test.finds_a_difference());
  EXPECT_FALSE(test.told_interval(0));  // it would tell all of them apart
  EXPECT_EQ(test.reading().find("do not overlap"), std::string_view::npos);
}

TEST(Friedman, TellsNothingApartWithoutADifference) {
  const FriedmanTest test = friedman_test({{9, 5}, {8, 6}});  // p = 0.157, intervals without width
  EXPECT_FALSE(test.finds_a_difference());
  EXPECT_FALSE(test.told_interval(0));
  EXPECT_EQ(test.reading().find("do not overlap"), std::string_view::npos);
}

TEST(Friedman, TellsApartWhereItFindsADifference) {
  const FriedmanTest test =
      friedman_test({{9, 5, 1}, {8, 6, 2}, {7, 4, 3}, {9, 8, 1}, {5, 6, 1}, {4, 3, 2}});
  EXPECT_TRUE(test.finds_a_difference());
  EXPECT_LT(test.told_interval(0)->high, test.told_interval(2)->low);
  EXPECT_NE(test.reading().find("do not overlap"), std::string_view::npos);
}

TEST(Friedman, OfTiesAloneHasNoP) {
  const FriedmanTest test = friedman_test({{1, 1}, {2, 2}});
  EXPECT_FALSE(test.p_value);
  EXPECT_EQ(test.mean_ranks, (std::vector<double>{1.5, 1.5}));
}

TEST(Friedman, OneBlockHasNoInterval) {
  EXPECT_FALSE(friedman_test({{1, 2}}).half_width);
}

}  // namespace
}  // namespace swarmsmith
