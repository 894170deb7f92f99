#pragma once

#include <span>

namespace swarmsmith::irace {

/// The mean of a sum that carries its rounding errors along (Neumaier's): equal values in another
/// order nearly always have equal means, as they do in R's wider numbers. This matters because
/// t-tests look at ties of means.
double mean_of(std::span<const double> values);

/// Sum of squared differences from `mean`, divided by n - 1.
double variance_of(std::span<const double> values, double mean);

}  // namespace swarmsmith::irace
