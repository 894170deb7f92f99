#include "irace_core/internal/means.h"

#include <cmath>

#include "base/assert.h"

namespace swarmsmith::irace {

double mean_of(std::span<const double> values) {
  SWARMSMITH_ASSERT(!values.empty(), "a mean is of one value or more");
  double sum = 0;
  double rest = 0;
  for (const double value : values) {
    const double next = sum + value;
    rest += std::fabs(sum) >= std::fabs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  return (sum + rest) / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values, double mean) {
  double squares = 0;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  return squares / (static_cast<double>(values.size()) - 1);
}

}  // namespace swarmsmith::irace
