#include "irace_core/internal/agreement.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"

namespace swarmsmith::irace {

std::optional<double> kendall_w(const RankTable& table, std::span<const std::size_t> columns) {
  // Source: irace facts, 10.4.
  if (table.rows() < 2 || columns.size() < 2) return std::nullopt;
  SWARMSMITH_ASSERT(static_cast<std::size_t>(table.columns()) == columns.size(),
                    "ranks are those among the columns that are compared");
  const auto n = static_cast<double>(table.rows());
  const auto k = static_cast<double>(columns.size());
  double spread = 0;
  for (const std::size_t column : columns) {
    const double distance = table.rank_sum(column) - n * (k + 1) / 2;
    spread += distance * distance;
  }
  const double most = n * n * (k * k * k - k) - n * table.ties();
  return most == 0 ? 1.0 : 12 * spread / most;
}

std::optional<double> spearman_rho(const RankTable& table, std::span<const std::size_t> columns) {
  const std::optional<double> w = kendall_w(table, columns);
  if (!w) return std::nullopt;
  const auto n = static_cast<double>(table.rows());
  return (n * *w - 1) / (n - 1);
}

void QualityVariance::add_row(std::span<const Entry> row) {
  if (row.empty()) return;
  const auto k = static_cast<double>(row.size());
  double mean = 0;
  for (const Entry& entry : row)
    mean += entry.cost;
  mean /= k;
  double square = 0;
  for (const Entry& entry : row)
    square += (entry.cost - mean) * (entry.cost - mean);
  // Rounding may make the mean differ slightly from costs that are all equal; standardising would
  // amplify that.
  const bool is_constant =
      std::ranges::all_of(row, [&](const Entry& entry) { return entry.cost == row.front().cost; });
  const double sd = is_constant ? 0 : std::sqrt(square / (k - 1));
  rows_ += 1;
  for (const Entry& entry : row) {
    const double z = sd > 0 ? (entry.cost - mean) / sd : 0;
    const double step = z - mean_[entry.column];
    mean_[entry.column] += step / rows_;
    square_[entry.column] += step * (z - mean_[entry.column]);
  }
}

void QualityVariance::reset() {
  rows_ = 0;
  std::fill(mean_.begin(), mean_.end(), 0.0);
  std::fill(square_.begin(), square_.end(), 0.0);
}

std::optional<double> QualityVariance::value(std::span<const std::size_t> columns) const {
  if (rows_ < 2 || columns.size() < 2) return std::nullopt;
  double sum = 0;
  for (const std::size_t column : columns)
    sum += square_[column] / (rows_ - 1);
  return sum / static_cast<double>(columns.size());
}

}  // namespace swarmsmith::irace
