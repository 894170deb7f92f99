#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/ranks.h"
#include "irace_core/internal/agreement.h"
#include "irace_core/internal/elimination.h"
#include "irace_core/internal/means.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith::irace {
namespace {

using testing::as_matrix;
using testing::as_vector;
using testing::golden;
using testing::kNotEvaluated;

/// One case of elimination.json with the columns that take part renumbered from 0.
struct Case {
  explicit Case(const nlohmann::json& json)
      : costs(as_matrix(json["costs"], kNotEvaluated)), table(0) {
    const std::size_t width = costs.front().size();
    if (json.contains("alive")) {
      for (const int column : as_vector<int>(json["alive"])) {
        alive.push_back(static_cast<std::size_t>(column - 1));
      }
    } else {
      alive.resize(width);
      std::iota(alive.begin(), alive.end(), std::size_t{0});
    }
    columns.resize(alive.size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    table = RankTable(alive.size());
    for (const auto& row : costs)
      table.add_row(entries(row));
  }

  std::vector<Entry> entries(const std::vector<double>& row) const {
    std::vector<Entry> result;
    for (std::size_t i = 0; i < alive.size(); ++i) {
      result.push_back({row[alive[i]], static_cast<std::uint32_t>(i)});
    }
    return result;
  }

  std::vector<double> column(std::size_t i) const {
    std::vector<double> values;
    for (const auto& row : costs)
      values.push_back(row[alive[i]]);
    return values;
  }

  std::vector<std::vector<double>> costs;
  std::vector<std::size_t> alive;    ///< columns of `costs`
  std::vector<std::size_t> columns;  ///< 0, 1, ... as many as take part
  RankTable table;
};

/// Survivors as column numbers from 1, and the p-value.
struct Decision {
  std::vector<int> survivors;
  double p_value;
};

std::vector<double> means_of(const Case& given) {
  std::vector<double> means;
  for (const std::size_t column : given.columns)
    means.push_back(mean_of(given.column(column)));
  return means;
}

TestResult t_tests(const Case& given, double alpha, TestType type) {
  std::vector<std::vector<double>> costs;
  for (const std::size_t column : given.columns)
    costs.push_back(given.column(column));
  const std::vector<std::span<const double>> views(costs.begin(), costs.end());
  return paired_t_tests(views, means_of(given), given.columns, alpha, type);
}

Decision decide(const Case& given, double confidence, TestType type) {
  const double alpha = 1 - confidence;
  std::vector<bool> drops(given.alive.size(), false);
  double p_value = 0;
  if (type != TestType::FTest) {
    const TestResult result = t_tests(given, alpha, type);
    for (const std::size_t column : result.dropped)
      drops[column] = true;
    p_value = result.p_value;
  } else if (given.alive.size() == 2) {
    const PairedResult result = wilcoxon_test(given.column(0), given.column(1), alpha);
    drops = {result.drops_first, result.drops_second};
    p_value = result.p_value;
  } else {
    StudentQuantiles quantiles(alpha / 2);
    const TestResult result = friedman_test(given.table, given.columns, alpha, quantiles);
    for (const std::size_t column : result.dropped)
      drops[column] = true;
    p_value = result.p_value;
  }
  std::vector<int> survivors;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (!drops[i]) survivors.push_back(static_cast<int>(given.alive[i]) + 1);
  }
  return {survivors, p_value};
}

TEST(EliminationGolden, DropsWhomIraceDropsAtEveryConfidence) {
  const std::vector<std::pair<std::string, double>> confidences = {
      {"confidence_0.95", 0.95}, {"confidence_0.99", 0.99}, {"confidence_0.80", 0.80}};
  const std::vector<std::pair<std::string, TestType>> types = {
      {"F_test", TestType::FTest},
      {"t_test", TestType::TTest},
      {"t_test_bonferroni", TestType::TTestBonferroni},
      {"t_test_holm", TestType::TTestHolm}};
  int compared = 0;
  for (const auto& json : golden("elimination.json")) {
    const Case given(json);
    for (const auto& [name, confidence] : confidences) {
      if (!json.contains(name)) continue;
      for (const auto& [test, type] : types) {
        SCOPED_TRACE("case " + json["id"].dump() + " " + name + " " + test);
        const auto& expected = json[name][test];
        const Decision decision = decide(given, confidence, type);
        // irace lists survivors best first or in order; who they are is what counts.
        auto survivors = as_vector<int>(expected["survivors"]);
        std::sort(survivors.begin(), survivors.end());
        EXPECT_EQ(decision.survivors, survivors);
        const double p = expected["p_value"].get<double>();
        EXPECT_NEAR(decision.p_value, p, 1e-12 + 1e-11 * p);
        EXPECT_EQ(decision.survivors.size() < given.alive.size(), expected["dropped_any"]);
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, (63 * 3 + 10) * 4);
}

TEST(EliminationGolden, RanksAndFindsTheBestAsIraceDoes) {
  int compared = 0;
  for (const auto& json : golden("elimination.json")) {
    if (!json.contains("friedman_ranks")) continue;
    SCOPED_TRACE("case " + json["id"].dump());
    const Case given(json);
    std::vector<double> sums;
    for (const std::size_t column : given.columns)
      sums.push_back(given.table.rank_sum(column));
    EXPECT_EQ(sums, as_vector<double>(json["friedman_ranks"]));
    const auto best = std::min_element(sums.begin(), sums.end()) - sums.begin();
    EXPECT_EQ(best + 1, json["best_friedman"]);
    const std::vector<double> means = means_of(given);
    EXPECT_EQ(average_ranks(means).ranks, as_vector<double>(json["mean_ranks"]));
    const auto least = std::min_element(means.begin(), means.end()) - means.begin();
    EXPECT_EQ(least + 1, json["best_mean"]);
    ++compared;
  }
  EXPECT_EQ(compared, 63);
}

TEST(EliminationGolden, ReportsTheAgreementThatIraceReports) {
  for (const auto& json : golden("elimination.json")) {
    if (!json.contains("kendall_w")) continue;
    SCOPED_TRACE("case " + json["id"].dump());
    const Case given(json);
    QualityVariance quality(given.columns.size());
    for (const auto& row : given.costs)
      quality.add_row(given.entries(row));
    EXPECT_NEAR(kendall_w(given.table, given.columns).value(), json["kendall_w"], 1e-12);
    EXPECT_NEAR(spearman_rho(given.table, given.columns).value(), json["spearman_rho"], 1e-12);
    EXPECT_NEAR(quality.value(given.columns).value(), json["qvar"], 1e-12);
  }
}

}  // namespace
}  // namespace swarmsmith::irace
