#include "analysis/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <vector>

namespace swarmsmith {
namespace {

using Values = std::vector<double>;

const Values kFirst = {3, 5, 4, 6, 2, 5, 7, 4};
const Values kSecond = {2, 4, 3, 3, 1, 6, 4, 2};

TEST(Bootstrap, GivesTheSameIntervalForTheSameValues) {
  const MeanDifference once = mean_difference(kFirst, kSecond);
  const MeanDifference again = mean_difference(kFirst, kSecond);
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
}

TEST(Bootstrap, HoldsTheDifferenceAndMovesWithIt) {
  const MeanDifference difference = mean_difference(kFirst, kSecond);
  EXPECT_EQ(difference.value, 36.0 / 8 - 25.0 / 8);
  EXPECT_LT(difference.low, difference.value);
  EXPECT_GT(difference.high, difference.value);
  Values moved = kFirst;
  for (double& value : moved)
    value += 16;
  const MeanDifference further = mean_difference(moved, kSecond);
  EXPECT_EQ(further.low, difference.low + 16);
  EXPECT_EQ(further.high, difference.high + 16);
}

TEST(Bootstrap, OfPairsThatDifferAllAlikeHasNoWidth) {
  Values moved = kFirst;
  for (double& value : moved)
    value += 2;
  const MeanDifference paired = paired_mean_difference(moved, kFirst);
  EXPECT_EQ(paired.low, 2);
  EXPECT_EQ(paired.high, 2);
  EXPECT_LT(mean_difference(moved, kFirst).low, 2);
}

TEST(Bootstrap, OfOneValueIsThatValue) {
  const MeanDifference difference = mean_difference(Values{5}, Values{3});
  EXPECT_EQ(difference.low, 2);
  EXPECT_EQ(difference.high, 2);
}

TEST(Bootstrap, OtherSeedsGiveOtherResamples) {
  const MeanDifference one = mean_difference(kFirst, kSecond, 101, 1);
  const MeanDifference other = mean_difference(kFirst, kSecond, 101, 2);
  EXPECT_TRUE(one.low != other.low || one.high != other.high);
}

TEST(Bootstrap, TakesTheGivenNumberOfResamples) {
  for (const auto& difference : {mean_difference, paired_mean_difference}) {
    const MeanDifference of_one = difference(kFirst, kSecond, 1, kBootstrapSeed);
    EXPECT_EQ(of_one.low, of_one.high);
    const MeanDifference of_two = difference(kFirst, kSecond, 2, kBootstrapSeed);
    EXPECT_LT(of_two.low, of_two.high);
  }
}

}  // namespace
}  // namespace swarmsmith
