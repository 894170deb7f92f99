#include "analysis/statistics/friedman.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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
  EXPECT_EQ(test.reading(),
            "They differ at 5 %. All blocks have the same order, so there are no intervals to tell "
            "which.");
}

TEST(Friedman, TellsNothingApartWithoutADifference) {
  // p = 0.157 with intervals without width; p = 0.564 with wide ones.
  for (const FriedmanTest& test :
       {friedman_test({{9, 5}, {8, 6}}), friedman_test({{9, 5}, {8, 6}, {5, 7}})}) {
    EXPECT_FALSE(test.finds_a_difference());
    EXPECT_TRUE(test.interval(0));
    EXPECT_FALSE(test.told_interval(0));
    EXPECT_EQ(test.reading(),
              "No difference is found at 5 %, so there are no intervals: the order may be chance.");
  }
}

TEST(Friedman, TellsApartWhereItFindsADifference) {
  const FriedmanTest test =
      friedman_test({{9, 5, 1}, {8, 6, 2}, {7, 4, 3}, {9, 8, 1}, {5, 6, 1}, {4, 3, 2}});
  EXPECT_TRUE(test.finds_a_difference());
  EXPECT_LT(test.told_interval(0)->high, test.told_interval(2)->low);
  EXPECT_EQ(test.reading(), "Intervals of 95 %: two that do not overlap differ at 5 %.");
}

TEST(Friedman, OfTiesAloneHasNoP) {
  const FriedmanTest test = friedman_test({{1, 1}, {2, 2}});
  EXPECT_FALSE(test.p_value);
  EXPECT_EQ(test.mean_ranks, (std::vector<double>{1.5, 1.5}));
}

TEST(Friedman, OneBlockHasNoInterval) {
  const FriedmanTest test = friedman_test({{1, 2}});
  EXPECT_FALSE(test.half_width);
  EXPECT_FALSE(test.interval(0));
}

}  // namespace
}  // namespace swarmsmith
