#pragma once

#include <algorithm>
#include <vector>

#include "base/assert.h"

namespace swarmsmith {

/// The median; for an even number of values, the larger of the two in the middle. At least one
/// value.
inline double upper_median(std::vector<double> values) {
  SWARMSMITH_ASSERT(!values.empty(), "a median needs a value");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The median; for an even number of values, the mean of the two in the middle.
inline double median_of(std::vector<double> values) {
  const double upper = upper_median(values);
  if (values.size() % 2 == 1) return upper;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return (upper + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace swarmsmith
