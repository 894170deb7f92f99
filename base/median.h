#pragma once

#include <algorithm>
#include <vector>

#include "base/assert.h"

namespace swarmsmith {

/// The value in the middle by size; of an even number the larger of the two there. At least one.
inline double upper_median(std::vector<double> values) {
  SWARMSMITH_ASSERT(!values.empty(), "a median of nothing");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The same, but of an even number the mean of the two.
inline double median_of(std::vector<double> values) {
  const double upper = upper_median(values);
  if (values.size() % 2 == 1) return upper;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return (upper + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace swarmsmith
