#pragma once

#include <cstddef>
#include <span>

namespace swarmsmith {

/// The arithmetic mean, rounded as in R's `mean`: it sums in long double, and corrects the rounding
/// error in a second pass. `values` must not be empty.
double mean_of(std::span<const double> values);

/// The quantile of `part` in [0, 1] as in R's `quantile`: type 7, linear between the two
/// neighbouring values (Hyndman and Fan 1996, definition 7). `values` must not be empty.
double quantile_of(std::span<const double> values, double part);

/// Descriptive statistics of a sample, as R's `mean`, `sd`, `quantile`.
struct Summary {
  std::size_t n = 0;
  double mean = 0;
  double sd = 0;  ///< divided by n - 1; NaN for a single value
  double least = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double most = 0;
};

/// Without values, n is 0 and all other fields are NaN.
Summary summary_of(std::span<const double> values);

/// A mean, and half of its 95 % interval by Student's t as in R's `t.test`; 0 for a single value.
struct MeanInterval {
  double mean = 0;
  double half_width = 0;
};

/// `values` must not be empty.
MeanInterval mean_interval(std::span<const double> values);

}  // namespace swarmsmith
