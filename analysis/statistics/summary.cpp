#include "analysis/statistics/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/special_functions.h"

namespace swarmsmith {
namespace {

/// The values must be in ascending order.
double sorted_quantile(std::span<const double> sorted, double part) {
  // The position of type 7, counted from 0: (n - 1) p.
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double over = place - static_cast<double>(below);
  // Between equal values the weighted sum could differ from them in the last bit. The first
  // condition also protects the last value, which has no neighbour above it.
  if (over == 0 || sorted[below] == sorted[below + 1]) return sorted[below];
  return (1 - over) * sorted[below] + over * sorted[below + 1];
}

}  // namespace

double mean_of(std::span<const double> values) {
  const auto n = static_cast<long double>(values.size());
  long double sum = 0;
  for (const double value : values)
    sum += value;
  const long double mean = sum / n;
  long double rest = 0;
  for (const double value : values)
    rest += value - mean;
  return static_cast<double>(mean + rest / n);
}

double quantile_of(std::span<const double> values, double part) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted_quantile(sorted, part);
}

Summary summary_of(std::span<const double> values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {0, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  Summary summary{.n = values.size(), .mean = mean_of(values), .sd = kNone};
  if (summary.n > 1) {
    long double squares = 0;
    for (const double value : values) {
      const long double off = static_cast<long double>(value) - summary.mean;
      squares += off * off;
    }
    summary.sd = static_cast<double>(std::sqrt(squares / static_cast<long double>(summary.n - 1)));
  }
  summary.least = sorted.front();
  summary.lower_quartile = sorted_quantile(sorted, 0.25);
  summary.median = sorted_quantile(sorted, 0.5);
  summary.upper_quartile = sorted_quantile(sorted, 0.75);
  summary.most = sorted.back();
  return summary;
}

MeanInterval mean_interval(std::span<const double> values) {
  constexpr double kOneTail = 0.025;
  const Summary summary = summary_of(values);
  if (summary.n < 2) return {summary.mean, 0};
  const auto n = static_cast<double>(summary.n);
  return {summary.mean, student_t_upper_quantile(kOneTail, n - 1) * summary.sd / std::sqrt(n)};
}

}  // namespace swarmsmith
