#pragma once

#include <span>

namespace swarmsmith::irace {

/// The mean, from a sum whose rounding errors are carried along (Neumaier's): equal values in
/// another order nearly always have equal means, as they do in R's wider numbers. Ties of means
/// count in t-tests.
double mean_of(std::span<const double> values);

/// Sum of squared differences from `mean`, divided by n - 1.
double variance_of(std::span<const double> values, double mean);

}  // namespace swarmsmith::irace
