#include "cli/output/mean_interval.h"

#include <cmath>
#include <cstddef>

namespace swarmsmith::cli {
namespace {

/// The 0.975 quantile of Student's t.
double student_quantile(std::size_t degrees) {
  if (degrees == 1) return 12.7062;
  if (degrees == 2) return 4.30265;
  constexpr double kZ = 1.959963984540054;
  const auto v = static_cast<double>(degrees);
  const double z3 = kZ * kZ * kZ;
  const double z5 = z3 * kZ * kZ;
  const double z7 = z5 * kZ * kZ;
  return kZ + (z3 + kZ) / (4 * v) + (5 * z5 + 16 * z3 + 3 * kZ) / (96 * v * v) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * kZ) / (384 * v * v * v);
}

}  // namespace

MeanInterval mean_interval(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  MeanInterval summary;
  for (const double value : values)
    summary.mean += value / n;
  if (values.size() < 2) return summary;
  double squares = 0;
  for (const double value : values)
    squares += (value - summary.mean) * (value - summary.mean);
  const double sd = std::sqrt(squares / (n - 1));
  summary.half_width = student_quantile(values.size() - 1) * sd / std::sqrt(n);
  return summary;
}

}  // namespace swarmsmith::cli
