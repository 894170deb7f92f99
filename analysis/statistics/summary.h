#pragma once

#include <cstddef>
#include <span>

namespace swarmsmith {

/// The arithmetic mean, rounded as R's `mean` rounds it: long sums, and a second pass for what the
/// first one lost. Not of nothing.
double mean_of(std::span<const double> values);

/// The quantile of `part` in [0, 1] as R's `quantile` gives it: its type 7, linear between the two
/// neighbouring values (Hyndman and Fan 1996, definition 7). Not of nothing.
double quantile_of(std::span<const double> values, double part);

/// What describes a sample; R's `mean`, `sd`, `quantile`.
struct Summary {
  std::size_t n = 0;
  double mean = 0;
  double sd = 0;  ///< with n - 1 below; NaN of one value
  double least = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double most = 0;
};

/// Of nothing, n is 0 and all else is NaN.
Summary summary_of(std::span<const double> values);

/// A mean, and half of Student's 95 % interval of it, as R's `t.test` gives it; 0 for one value.
struct MeanInterval {
  double mean = 0;
  double half_width = 0;
};

/// Not of nothing.
MeanInterval mean_interval(std::span<const double> values);

}  // namespace swarmsmith
