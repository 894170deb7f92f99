#include "irace_core/internal/elimination.h"

#include <cmath>

#include "base/special_functions.h"
#include "irace_core/internal/agreement.h"
#include "irace_core/internal/ranking.h"
#include "tests/support/checks.h"

namespace swarmsmith::irace {
namespace {

RankTable table_of(const std::vector<std::vector<double>>& rows) {
  RankTable table(rows.front().size());
  for (const auto& row : rows) {
    std::vector<Entry> entries;
    for (std::size_t c = 0; c < row.size(); ++c) {
      entries.push_back({row[c], static_cast<std::uint32_t>(c)});
    }
    table.add_row(std::move(entries));
  }
  return table;
}

constexpr std::size_t kThree[] = {0, 1, 2};

TEST(RankTable, GivesTiesTheirAverageRank) {
  const RankTable table = table_of({{5, 2, 5}, {1, 1, 1}});
  EXPECT_EQ(table.rank_sum(0), 2.5 + 2);
  EXPECT_EQ(table.rank_sum(1), 1.0 + 2);
  EXPECT_EQ(table.ties(), 6 + 24);  // 2^3 - 2 and 3^3 - 3
  EXPECT_EQ(table.squares(), 2 * 2.5 * 2.5 + 1 + 3 * 4);
}

TEST(RankTable, RanksTheRestAgainWhenColumnsGo) {
  RankTable table = table_of({{5, 2, 5}, {3, 1, 2}});
  table.keep({true, false, true});
  const RankTable fresh = table_of({{5, 5}, {3, 2}});
  EXPECT_EQ(table.columns(), 2);
  EXPECT_EQ(table.rank_sum(0), fresh.rank_sum(0));
  EXPECT_EQ(table.rank_sum(2), fresh.rank_sum(1));
  EXPECT_EQ(table.ties(), fresh.ties());
  EXPECT_EQ(table.squares(), fresh.squares());
}

TEST(Friedman, DecidesNothingWhenAllAreTied) {
  StudentQuantiles quantiles(0.025);
  const TestResult result =
      friedman_test(table_of({{1, 1, 1}, {2, 2, 2}}), kThree, 0.05, quantiles);
  EXPECT_TRUE(std::isnan(result.p_value));
  EXPECT_THAT(result.dropped, IsEmpty());
}

TEST(Friedman, CannotTellDifferencesOnASinglePair) {
  StudentQuantiles quantiles(0.25);  // p = e^-1 is below alpha
  const TestResult result = friedman_test(table_of({{1, 2, 3}}), kThree, 0.5, quantiles);
  EXPECT_NEAR(result.p_value, 0.3679, 1e-4);
  EXPECT_THAT(result.dropped, IsEmpty());
}

TEST(Friedman, KeepsThoseWithinTheCriticalDifference) {
  // Columns 0 and 1 take turns at the first place, 2 is always last: R = 9, 9, 18, S = 9,
  // p = e^-4.5; the difference is t * sqrt(2 (6*84 - 486) / 10) = 2.23 * 1.9 = 4.2.
  StudentQuantiles quantiles(0.025);
  const TestResult result =
      friedman_test(table_of({{1, 2, 3}, {2, 1, 3}, {1, 2, 3}, {2, 1, 3}, {1, 2, 3}, {2, 1, 3}}),
                    kThree, 0.05, quantiles);
  EXPECT_NEAR(result.statistic, 9, 1e-12);
  EXPECT_NEAR(result.p_value, std::exp(-4.5), 1e-12);
  EXPECT_THAT(result.dropped, ElementsAre(2U));
}

/// The same ranks: 2 is 9 behind the best, and t = 9 / sqrt(3.6) with 10 degrees of freedom.
TEST(Friedman, DropsWhatIsFurtherBehindThanTheCriticalDifference) {
  const RankTable table =
      table_of({{1, 2, 3}, {2, 1, 3}, {1, 2, 3}, {2, 1, 3}, {1, 2, 3}, {2, 1, 3}});
  const double tail = student_t_two_sided_tail(9 / std::sqrt(3.6), 10) / 2;
  StudentQuantiles smaller(tail * 1.001);
  EXPECT_THAT(friedman_test(table, kThree, 0.05, smaller).dropped, ElementsAre(2U));
  StudentQuantiles larger(tail * 0.999);
  EXPECT_THAT(friedman_test(table, kThree, 0.05, larger).dropped, IsEmpty());
}

/// Ranks 1 2 3 in each of two rows: S = 4, and the rows agree, so that the difference is 0.
TEST(Friedman, DropsAllButTheBestFromTwoRowsThatAgree) {
  const RankTable table = table_of({{1, 2, 3}, {1, 2, 3}});
  StudentQuantiles quantiles(0.025);
  const double p = std::exp(-2.0);
  EXPECT_THAT(friedman_test(table, kThree, p * 1.001, quantiles).dropped, ElementsAre(1U, 2U));
  const TestResult kept = friedman_test(table, kThree, p * 0.999, quantiles);
  EXPECT_THAT(kept.dropped, IsEmpty());
  EXPECT_NEAR(kept.p_value, p, 1e-12);
  EXPECT_NEAR(kept.statistic, 4, 1e-12);
  EXPECT_THAT(friedman_test(table, kThree, kept.p_value, quantiles).dropped, IsEmpty())
      << "p must be below alpha";
}

TEST(Wilcoxon, DropsOneThatIsNeverBetterWithoutATest) {
  const std::vector<double> good{1, 2, 3};
  const std::vector<double> bad{1, 3, 4};
  EXPECT_TRUE(wilcoxon_test(good, bad, 0.05).drops_second);
  EXPECT_TRUE(wilcoxon_test(bad, good, 0.05).drops_first);
  EXPECT_EQ(wilcoxon_test(bad, good, 0.05).p_value, 0);
}

TEST(Wilcoxon, DropsTheSecondOfTwoEqualOnes) {
  const std::vector<double> same{1, 2, 3};
  EXPECT_TRUE(wilcoxon_test(same, same, 0.05).drops_second);
}

TEST(Wilcoxon, CountsExactlyWithoutTies) {
  // Differences -1 2 -3 -4 -5 -6 -7: V = 2; subsets of {1..7} with sum <= 2: {}, {1}, {2}.
  const std::vector<double> first{0, 2, 0, 0, 0, 0, 0};
  const std::vector<double> second{1, 0, 3, 4, 5, 6, 7};
  const PairedResult result = wilcoxon_test(first, second, 0.05);
  EXPECT_EQ(result.statistic, 2);
  EXPECT_EQ(result.p_value, 2 * 3 / 128.0);
  EXPECT_TRUE(result.drops_second);
  EXPECT_FALSE(result.drops_first);
  EXPECT_TRUE(wilcoxon_test(second, first, 0.05).drops_first);
  const PairedResult limit = wilcoxon_test(first, second, 2 * 3 / 128.0);
  EXPECT_FALSE(limit.drops_second) << "p must be below alpha";
}

/// All differences but the smallest have one sign: two sums of 2^n are as large or larger.
TEST(Wilcoxon, CountsExactlyUpTo49Pairs) {
  const auto p_of = [](std::size_t n) {
    std::vector<double> first(n, 0);
    std::vector<double> second;
    for (std::size_t i = 1; i <= n; ++i)
      second.push_back(static_cast<double>(i));
    first[0] = 2;  // a difference of 1, the others are -2, -3, ...
    return wilcoxon_test(first, second, 0.05).p_value;
  };
  EXPECT_EQ(p_of(49), 2 * 2 * std::pow(0.5, 49));
  // V = 1, mean 637.5, variance 50 * 51 * 101 / 24 = 10731.25: z = -636 / 103.59.
  EXPECT_NEAR(p_of(50) / std::erfc(636 / std::sqrt(2 * 10731.25)), 1, 1e-9);
}

TEST(Wilcoxon, ApproximatesWithZerosAndTies) {
  // V is its mean: no correction, and p = 1.
  const std::vector<double> up{1, 0};
  const std::vector<double> down{0, 1};
  EXPECT_EQ(wilcoxon_test(up, down, 0.5).statistic, 1.5);
  EXPECT_EQ(wilcoxon_test(up, down, 0.5).p_value, 1);
  // V is half a rank from its mean of 1.5, on either side, and the correction takes that away.
  EXPECT_EQ(wilcoxon_test(std::vector<double>{1, 0, 5}, std::vector<double>{0, 2, 5}, 0.5).p_value,
            1);
  EXPECT_EQ(wilcoxon_test(std::vector<double>{0, 2, 5}, std::vector<double>{1, 0, 5}, 0.5).p_value,
            1);
  // Differences 1 -2 -2 0: ranks 1, 2.5, 2.5, V = 1, mean 3, variance 3*4*7/24 - 6/48 = 3.375.
  const std::vector<double> first{1, 0, 0, 5};
  const std::vector<double> second{0, 2, 2, 5};
  const double expected = std::erfc(1.5 / std::sqrt(2 * 3.375));
  EXPECT_EQ(wilcoxon_test(first, second, 0.05).statistic, 1);
  EXPECT_NEAR(wilcoxon_test(first, second, 0.05).p_value, expected, 1e-12);
  EXPECT_NEAR(wilcoxon_test(second, first, 0.05).p_value, expected, 1e-12);
}

/// Signed ranks and pseudo-median need not agree with the mean: of 4, -1, -2 the pairwise means are
/// 4, 1.5, 1, -1, -1.5, -2, with a median of 0.
TEST(Wilcoxon, PrefersTheFirstWhereThePseudoMedianIsZero) {
  const std::vector<double> first{4, 0, 0};
  const std::vector<double> second{0, 1, 2};
  const PairedResult tied = wilcoxon_test(first, second, 1.5);
  EXPECT_TRUE(tied.drops_second);
  EXPECT_FALSE(tied.drops_first);
  // 5 in place of 4: 5, 2, 1.5, -1, -1.5, -2, with a median of 0.25.
  const std::vector<double> worse{5, 0, 0};
  EXPECT_TRUE(wilcoxon_test(worse, second, 1.5).drops_first);
  // 4, -1: the middle one of 4, 1.5, -1.
  EXPECT_TRUE(wilcoxon_test(std::vector<double>{4, 0}, std::vector<double>{0, 1}, 1.5).drops_first);
}

TEST(Agreement, IsOneForEqualRowsAndUndefinedForOne) {
  const RankTable same = table_of({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(kendall_w(same, kThree), 1);
  EXPECT_EQ(spearman_rho(same, kThree), 1);
  EXPECT_EQ(kendall_w(table_of({{1, 2, 3}}), kThree), std::nullopt);
  EXPECT_EQ(spearman_rho(table_of({{1, 2, 3}}), kThree), std::nullopt);
  constexpr std::size_t kOne[] = {0};
  EXPECT_EQ(kendall_w(table_of({{1}, {2}}), kOne), std::nullopt);
}

TEST(Agreement, TakesTiesIntoAccount) {
  const RankTable table = table_of({{1, 2, 3}, {2, 2.5, 2.5}, {5, 5, 5}});
  // Rank sums 4, 6.5, 7.5: squared distances from 6 are 4, 0.25, 2.25; ties 6 + 24.
  const double w = 12 * 6.5 / (9 * 24 - 3 * 30);
  EXPECT_NEAR(kendall_w(table, kThree).value(), w, 1e-12);
  EXPECT_NEAR(spearman_rho(table, kThree).value(), (3 * w - 1) / 2, 1e-12);
  EXPECT_EQ(kendall_w(table_of({{1, 1, 1}, {2, 2, 2}}), kThree), 1) << "nothing is ranked";
}

TEST(Agreement, IsMinusOneForOppositeRows) {
  EXPECT_EQ(spearman_rho(table_of({{1, 2, 3}, {3, 2, 1}}), kThree), -1);
}

/// Three times 0.1 sums to more than 0.3: the rest of the mean must not be standardised.
TEST(QualityVariance, TakesARowOfEqualCostsForZeros) {
  QualityVariance quality(3);
  const std::vector<Entry> equal = {{0.1, 0}, {0.1, 1}, {0.1, 2}};
  quality.add_row(equal);
  quality.add_row(equal);
  EXPECT_EQ(quality.value(kThree), 0.0);
  // And -1, 0, 1: variances 1/3, 0, 1/3 of three rows.
  quality.add_row(std::vector<Entry>{{1, 0}, {2, 1}, {3, 2}});
  EXPECT_NEAR(quality.value(kThree).value(), 2.0 / 9, 1e-12);
  quality.reset();
  EXPECT_EQ(quality.value(kThree), std::nullopt);
}

TEST(QualityVariance, NeedsTwoColumns) {
  QualityVariance quality(2);
  for (int row = 0; row < 2; ++row) {
    quality.add_row({});
    quality.add_row(std::vector<Entry>{{1, 0}, {2, 1}});
  }
  EXPECT_EQ(quality.value(std::vector<std::size_t>{0}), std::nullopt);
  EXPECT_EQ(quality.value(std::vector<std::size_t>{0, 1}), 0.0);
}

TEST(QualityVariance, AveragesTheVarianceOfStandardisedRows) {
  // Standardised rows are (-1, 0, 1) and (1, 0, -1): variances 2, 0, 2.
  QualityVariance quality(3);
  quality.add_row(std::vector<Entry>{{10, 0}, {20, 1}, {30, 2}});
  EXPECT_EQ(quality.value(kThree), std::nullopt);
  quality.add_row(std::vector<Entry>{{3, 0}, {2, 1}, {1, 2}});
  EXPECT_NEAR(quality.value(kThree).value(), 4.0 / 3, 1e-12);
}

TEST(OverallRanks, PutMorePairsBeforeBetterCosts) {
  const double none = std::nan("");
  EXPECT_THAT(overall_ranks({{9, 9, 9}, {1, 1, none}, {2, 2, none}}, TestType::FTest),
              ElementsAre(1, 3, 5));
}

TEST(OverallRanks, RankWithinCommonPairsAlone) {
  const double none = std::nan("");
  // Two pairs each, and one in common, on which the second is the better one.
  const std::vector<std::vector<double>> costs = {{1, 9, none}, {none, 5, 7}};
  for (const TestType type : {TestType::FTest, TestType::TTest})
    EXPECT_THAT(overall_ranks(costs, type), ElementsAre(2, 1));
  // No pair in common: the sums of no ranks are 0, and means of no costs are equal.
  const std::vector<std::vector<double>> apart = {{1, none}, {none, 5}};
  EXPECT_THAT(overall_ranks(apart, TestType::FTest), ElementsAre(0, 0));
  EXPECT_THAT(overall_ranks(apart, TestType::TTest), ElementsAre(1.5, 1.5));
}

}  // namespace
}  // namespace swarmsmith::irace
