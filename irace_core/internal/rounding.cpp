#include "irace_core/internal/rounding.h"

#include <array>
#include <cmath>

#include "base/assert.h"

namespace swarmsmith::irace {

double round_to_digits(double value, int digits) {
  static constexpr std::array<double, 16> kPowersOfTen = {
      1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  SWARMSMITH_ASSERT(digits >= 0 && digits <= 15, "decimals lie in 0..15");
  const double power = kPowersOfTen[static_cast<std::size_t>(digits)];
  const double magnitude = std::fabs(value);
  // With this many decimals, rounding would not change the number (R's fround).
  constexpr double kLog10Of2 = 0.301029995663981195;
  constexpr int kDigits = 15;
  if (!std::isfinite(value) || value == 0 ||
      kLog10Of2 * (0.5 + std::logb(magnitude)) + digits > kDigits)
    return value;
  const double scaled = magnitude * power;
  const double below = std::floor(scaled);
  const double low = below / power;
  const double high = std::ceil(scaled) / power;
  const double to_low = magnitude - low;
  const double to_high = high - magnitude;
  const bool low_is_even = below == 2 * std::floor(below / 2);
  const double rounded = to_low < to_high || (to_low == to_high && low_is_even) ? low : high;
  if (rounded == 0) return 0;
  return value < 0 ? -rounded : rounded;
}

}  // namespace swarmsmith::irace
