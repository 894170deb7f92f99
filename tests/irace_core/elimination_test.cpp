#include "irace_core/internal/elimination.h"

#include <cmath>

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
  EXPECT_FALSE(wilcoxon_test(first, second, 0.04).drops_second);
}

TEST(Agreement, IsOneForEqualRowsAndUndefinedForOne) {
  const RankTable same = table_of({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(kendall_w(same, kThree), 1);
  EXPECT_EQ(spearman_rho(same, kThree), 1);
  EXPECT_EQ(kendall_w(table_of({{1, 2, 3}}), kThree), std::nullopt);
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
  EXPECT_EQ(quality.value(std::vector<std::size_t>{0, 1, 2}), 0.0);
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

}  // namespace
}  // namespace swarmsmith::irace
