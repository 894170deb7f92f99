#include "analysis/statistics/wilcoxon.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace swarmsmith {
namespace {

using Values = std::vector<double>;

TEST(RankSum, OfSamplesThatDoNotOverlapIsOneArrangementOfAll) {
  const WilcoxonTest test = rank_sum_test(Values{4, 5, 6}, Values{1, 2, 3});
  EXPECT_EQ(test.statistic, 9);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(*test.p_value, 2.0 / 20);
  EXPECT_DOUBLE_EQ(test.least_p, 2.0 / 20);
  EXPECT_DOUBLE_EQ(*rank_sum_test(Values{4, 5, 6}, Values{1, 2, 3}, Alternative::Greater).p_value,
                   1.0 / 20);
}

TEST(RankSum, ExchangedSamplesExchangeTheSides) {
  const Values first = {1, 3, 3, 8};
  const Values second = {2, 3, 9};
  EXPECT_EQ(rank_sum_test(first, second).p_value, rank_sum_test(second, first).p_value);
  EXPECT_EQ(rank_sum_test(first, second, Alternative::Greater).p_value,
            rank_sum_test(second, first, Alternative::Less).p_value);
}

TEST(RankSum, TiesAndFiftyValuesTakeTheNormalApproximation) {
  EXPECT_FALSE(rank_sum_test(Values{1, 2}, Values{2, 3}).exact);
  Values many(50);
  std::iota(many.begin(), many.end(), 0.0);
  EXPECT_FALSE(rank_sum_test(many, Values{0.5}).exact);
  many.pop_back();
  EXPECT_TRUE(rank_sum_test(many, Values{0.5}).exact);
}

TEST(RankSum, OfEqualValuesHasNoP) {
  EXPECT_FALSE(rank_sum_test(Values{3, 3}, Values{3, 3, 3}).p_value);
}

TEST(SignedRank, OfDifferencesOfOneSignIsOneOfAllSigns) {
  const WilcoxonTest test = signed_rank_test(Values{2, 4, 6, 8, 10}, Values{1, 2, 3, 4, 5});
  EXPECT_EQ(test.statistic, 15);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(*test.p_value, 2.0 / 32);
  EXPECT_DOUBLE_EQ(test.least_p, 2.0 / 32);
}

TEST(SignedRank, DropsZeros) {
  const WilcoxonTest with = signed_rank_test(Values{1, 5, 2, 7}, Values{1, 2, 4, 1});
  const WilcoxonTest without = signed_rank_test(Values{5, 2, 7}, Values{2, 4, 1});
  EXPECT_EQ(with.zeros, 1U);
  EXPECT_EQ(with.statistic, without.statistic);
  EXPECT_FALSE(with.exact);
  EXPECT_TRUE(without.exact);
}

TEST(SignedRank, OfZerosAloneHasNoP) {
  const WilcoxonTest test = signed_rank_test(Values{1, 2}, Values{1, 2});
  EXPECT_FALSE(test.p_value);
  EXPECT_EQ(test.zeros, 2U);
  EXPECT_EQ(test.least_p, 1);
}

}  // namespace
}  // namespace swarmsmith
