#include "irace_core/internal/rounding.h"

#include <array>
#include <cmath>

#include "base/assert.h"

namespace swarmsmith::irace {

double round_to_digits(double value, int digits) {
  static constexpr std::array<double, 16> kPowersOfTen = {
      1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  SWARMSMITH_ASSERT(digits >= -kMostZeros && digits <= 15, "decimals lie in -309..15");
  double power = 1;
  double unit = 1;  // of digits below 0
  if (digits >= 0) {
    power = kPowersOfTen[static_cast<std::size_t>(digits)];
  } else {
    for (int i = digits; i < 0; ++i)
      unit *= 10;
  }
  const double magnitude = std::fabs(value);
  // With this many decimals, rounding would not change the number (R's fround).
  constexpr double kLog10Of2 = 0.301029995663981195;
  constexpr int kDigits = 15;
  if (!std::isfinite(value) || value == 0 ||
      kLog10Of2 * (0.5 + std::logb(magnitude)) + digits > kDigits)
    return value;
  if (std::isinf(unit)) return 0;
  const double scaled = magnitude * power / unit;
  const double below = std::floor(scaled);
  const double low = below / power * unit;
  const double high = std::ceil(scaled) / power * unit;
  const double to_low = magnitude - low;
  const double to_high = high - magnitude;
  const bool low_is_even = below == 2 * std::floor(below / 2);
  const double rounded = to_low < to_high || (to_low == to_high && low_is_even) ? low : high;
  if (rounded == 0) return 0;
  return value < 0 ? -rounded : rounded;
}

}  // namespace swarmsmith::irace
