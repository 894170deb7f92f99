#pragma once

#include <span>

namespace swarmsmith::cli {

struct MeanInterval {
  double mean = 0;
  double half_width = 0;  ///< of the 95 % interval of the mean; 0 for one value
};

/// Student's interval. Its quantile: exact for one and two degrees of freedom, else the expansion
/// around the normal one (Abramowitz and Stegun 26.7.5), relative error below 0.5 %.
MeanInterval mean_interval(std::span<const double> values);

}  // namespace swarmsmith::cli
