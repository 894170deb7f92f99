#pragma once

#include <span>

namespace swarmsmith {

/// The quantile of `part` in [0, 1] of values that are sorted and not none: R's type 7, linear
/// between the two neighbouring values (Hyndman and Fan 1996, definition 7).
double type_7_quantile(std::span<const double> sorted, double part);

}  // namespace swarmsmith
