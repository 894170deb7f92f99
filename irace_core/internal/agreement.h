#pragma once

#include <optional>
#include <span>
#include <vector>

#include "irace_core/internal/ranks.h"

namespace swarmsmith::irace {

/// How similarly the rows rank the columns: Kendall's coefficient of concordance W, 1 if everything
/// is tied; nothing for a single row or column.
std::optional<double> kendall_w(const RankTable& table, std::span<const std::size_t> columns);

/// Mean of Spearman's rank correlation over all pairs of rows, from W.
std::optional<double> spearman_rho(const RankTable& table, std::span<const std::size_t> columns);

/// How differently the columns behave from row to row: each row is standardised (n-1; a constant
/// row becomes zero), then the variance of each column over the rows is averaged over the columns.
/// The class keeps running means and squares, so that a further row costs one pass over it.
class QualityVariance {
 public:
  explicit QualityVariance(std::size_t columns) : mean_(columns, 0), square_(columns, 0) {}

  /// `row` has one entry for every column that takes part; these must be the same columns in each
  /// call.
  void add_row(std::span<const Entry> row);
  /// Removes all rows, for instance after columns were dropped.
  void reset();
  /// The mean variance of `columns`; nothing for a single row or column.
  std::optional<double> value(std::span<const std::size_t> columns) const;

 private:
  double rows_ = 0;
  std::vector<double> mean_;
  std::vector<double> square_;  ///< sum of squared differences from the mean
};

}  // namespace swarmsmith::irace
