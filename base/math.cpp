#include "base/math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

// Only exact operations of the standard library are used here: sqrt, floor, fabs, isnan.

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// ln 2 and pi/2 in pieces: the leading ones have trailing zero bits, so that small multiples of
/// them are exact (Cody and Waite's argument reduction).
constexpr double kLn2High = 0x1.62e42fee00000p-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kHalfPi1 = 0x1.921fb54000000p+0;
constexpr double kHalfPi2 = 0x1.10b4611000000p-30;
constexpr double kHalfPi3 = 0x1.4c4c6628b80dcp-59;

/// c[0] + c[1] x + c[2] x^2 + ...
template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i > 0; --i)
    sum = sum * x + c[i - 1];
  return sum;
}

/// x * 2^n, for results that are normal numbers or after a second scaling.
double scale(double x, int n) {
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
}

/// std::floor for a value that fits into an integer, without calling the C library.
double whole_below(double x) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1 : whole;
}

/// sin(r) for |r| <= pi/4: Taylor, the first term left out is r^19 / 19!, below 1e-19.
double sin_kernel(double r) {
  static constexpr std::array<double, 8> kCoefficients = {
      -1.0 / 6,        1.0 / 120,         -1.0 / 5040,         1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800., -1.0 / 1307674368e3, 1.0 / 355687428096e3};
  const double s = r * r;
  return r + r * s * polynomial(kCoefficients, s);
}

double cos_kernel(double r) {
  static constexpr std::array<double, 8> kCoefficients = {
      1.0 / 24,         -1.0 / 720,          1.0 / 40320,         -1.0 / 3628800,
      1.0 / 479001600., -1.0 / 87178291200., 1.0 / 20922789888e3, -1.0 / 6402373705728e3};
  const double s = r * r;
  const double half = 0.5 * s;
  const double head = 1.0 - half;
  // (1 - head) - half is the rounding error of the head.
  return head + (((1.0 - head) - half) + s * s * polynomial(kCoefficients, s));
}

/// atan(t) for 0 <= t <= 0.2: Taylor up to t^23; the first term left out is below 2e-19.
double atan_kernel(double t) {
  static constexpr std::array<double, 11> kCoefficients = {-1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,
                                                           -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17,
                                                           -1.0 / 19, 1.0 / 21, -1.0 / 23};
  const double s = t * t;
  return t + t * s * polynomial(kCoefficients, s);
}

/// atan(t) for 0 <= t <= 1: from the nearest k/4, atan(t) = atan(k/4) + atan((t - k/4)/(1 + t
/// k/4)).
double atan_unit(double t) {
  static constexpr std::array<double, 5> kAtanQuarters = {
      0.0, 0.24497866312686415, 0.4636476090008061, 0.6435011087932844, 0.7853981633974483};
  // Any rounding of halves is good enough: both neighbours are near.
  const int k = static_cast<int>(t * 4.0 + 0.5);  // NOLINT(bugprone-incorrect-roundings)
  if (k == 0) return atan_kernel(t);
  const double quarter = k / 4.0;
  const double rest = (t - quarter) / (1.0 + t * quarter);
  return kAtanQuarters[static_cast<std::size_t>(k)] +
         (rest < 0 ? -atan_kernel(-rest) : atan_kernel(rest));
}

/// erf(x) for 0 <= x <= 2.5 by its Maclaurin series in the form without cancellation,
/// 2/sqrt(pi) e^(-x^2) sum 2^n x^(2n+1) / (2n+1)!!.
double erf_series(double x) {
  double term = x;
  double sum = x;
  for (int n = 1; n < 200 && term > 1e-18 * sum; ++n) {
    term *= 2.0 * x * x / (2 * n + 1);
    sum += term;
  }
  return 1.1283791670955126 * exp(-x * x) * sum;
}

/// erfc(x) for x > 2 by its continued fraction, from the inside out.
double erfc_fraction(double x) {
  double tail = 0;
  for (int n = 120; n > 0; --n)
    tail = 0.5 * n / (x + tail);
  return 0.5641895835477563 * exp(-x * x) / (x + tail);
}

}  // namespace

SinCos sin_cos(double angle_rad) {
  const double quadrant = std::floor(angle_rad * (2.0 / kPi) + 0.5);
  const double r = ((angle_rad - quadrant * kHalfPi1) - quadrant * kHalfPi2) - quadrant * kHalfPi3;
  const double s = sin_kernel(r);
  const double c = cos_kernel(r);
  switch (static_cast<std::int64_t>(quadrant) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double atan2(double y, double x) {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? atan_unit(ay / ax) : kPi / 2 - atan_unit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double exp(double x) {
  static constexpr std::array<double, 14> kCoefficients = {1.0,
                                                           1.0,
                                                           1.0 / 2,
                                                           1.0 / 6,
                                                           1.0 / 24,
                                                           1.0 / 120,
                                                           1.0 / 720,
                                                           1.0 / 5040,
                                                           1.0 / 40320,
                                                           1.0 / 362880,
                                                           1.0 / 3628800,
                                                           1.0 / 39916800,
                                                           1.0 / 479001600.,
                                                           1.0 / 6227020800.};
  if (std::isnan(x)) return x;
  if (x > 709.8) return kInfinity;
  if (x < -745.2) return 0;
  const double n = whole_below(x * 1.4426950408889634 + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  const double value = polynomial(kCoefficients, r);
  // Two steps, since 2^n alone may leave the range of normal numbers.
  const int half = static_cast<int>(n) / 2;
  return scale(scale(value, half), static_cast<int>(n) - half);
}

double log(double x) {
  static constexpr std::array<double, 11> kCoefficients = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,
                                                           2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17,
                                                           2.0 / 19, 2.0 / 21, 2.0 / 23};
  if (std::isnan(x) || x < 0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0) return -kInfinity;
  if (x == kInfinity) return x;
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {  // subnormal
    x *= 0x1p54;
    exponent = -54;
  }
  auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52U) - 1023;
  bits = (bits & 0x000fffffffffffffU) | 0x3ff0000000000000U;
  auto m = std::bit_cast<double>(bits);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  // log m = 2 atanh(s) with s = (m-1)/(m+1), written as f - (f^2/2 - s (f^2/2 + tail)) so that the
  // leading term f = m - 1 is exact.
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double s2 = s * s;
  const double tail = s2 * polynomial(kCoefficients, s2);
  const double half_square = 0.5 * f * f;
  return exponent * kLn2High -
         ((half_square - (s * (half_square + tail) + exponent * kLn2Low)) - f);
}

double pow(double base, double exponent) {
  return exp(exponent * log(base));
}

double normal_cdf(double x) {
  const double z = std::fabs(x) / 1.4142135623730951;
  if (z < 2.0) {
    const double half = 0.5 * erf_series(z);
    return x < 0 ? 0.5 - half : 0.5 + half;
  }
  const double upper = 0.5 * erfc_fraction(z);
  return x < 0 ? upper : 1.0 - upper;
}

double normal_quantile(double p) {
  static constexpr std::array<double, 8> kMiddleTop = {
      3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
      1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
      3.3430575583588128105e4, 2.5090809287301226727e3};
  static constexpr std::array<double, 8> kMiddleBottom = {1.0,
                                                          4.2313330701600911252e1,
                                                          6.8718700749205790830e2,
                                                          5.3941960214247511077e3,
                                                          2.1213794301586595867e4,
                                                          3.9307895800092710610e4,
                                                          2.8729085735721942674e4,
                                                          5.2264952788528545610e3};
  static constexpr std::array<double, 8> kNearTop = {
      1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
      3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
      2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr std::array<double, 8> kNearBottom = {1.0,
                                                        2.05319162663775882187e0,
                                                        1.67638483018380384940e0,
                                                        6.89767334985100004550e-1,
                                                        1.48103976427480074590e-1,
                                                        1.51986665636164571966e-2,
                                                        5.47593808499534494600e-4,
                                                        1.05075007164441684324e-9};
  static constexpr std::array<double, 8> kFarTop = {
      6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
      2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
      2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr std::array<double, 8> kFarBottom = {1.0,
                                                       5.99832206555887937690e-1,
                                                       1.36929880922735805310e-1,
                                                       1.48753612908506148525e-2,
                                                       7.86869131145613259100e-4,
                                                       1.84631831751005468180e-5,
                                                       1.42151175831644588870e-7,
                                                       2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (std::fabs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kMiddleTop, r) / polynomial(kMiddleBottom, r);
  }
  const double tail = q < 0 ? p : 1.0 - p;
  if (tail <= 0) return q < 0 ? -kInfinity : kInfinity;
  const double r = std::sqrt(-log(tail));
  const double z = r <= 5.0 ? polynomial(kNearTop, r - 1.6) / polynomial(kNearBottom, r - 1.6)
                            : polynomial(kFarTop, r - 5.0) / polynomial(kFarBottom, r - 5.0);
  return q < 0 ? -z : z;
}

double wrap_angle(double angle_rad) {
  const double turns = std::floor(angle_rad / (2.0 * kPi) + 0.5);
  double wrapped = angle_rad - turns * (2.0 * kPi);
  if (wrapped <= -kPi) wrapped += 2.0 * kPi;
  return wrapped;
}

double hypot(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace swarmsmith
