#include "base/special_functions.h"

#include <cmath>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kHalfLogTwoPi = 0.9189385332046728;
constexpr double kTiny = 1e-300;
constexpr double kPrecision = 1e-16;

/// log_gamma(x) minus Stirling's (x - 1/2) ln x - x + ln(2 pi)/2: from 15 on by the asymptotic
/// series, below that by the recurrence from x + 1 to x.
double stirling_rest(double x) {
  double rest = 0;
  while (x < 15) {
    rest += (x + 0.5) * log((x + 1) / x) - 1;
    x += 1;
  }
  const double s = 1 / (x * x);
  return rest + (1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680 - s / 1188)))) / x;
}

/// x^a e^-x / Gamma(a), without the cancellation of its three large logarithms.
double gamma_factor(double a, double x) {
  const double exponent = a * log(x / a) + (a - x) - stirling_rest(a);
  return exp(exponent) * std::sqrt(a / (2 * kPi));
}

/// Lower regularised incomplete gamma function by its power series, for x < a + 1.
double gamma_series(double a, double x) {
  double term = 1 / a;
  double sum = term;
  for (int n = 1; n < 10'000 && term > sum * kPrecision; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * gamma_factor(a, x);
}

/// Lentz's evaluation of a continued fraction b0 + a1/(b1 + a2/(b2 + ...)), one term per call.
class ContinuedFraction {
 public:
  explicit ContinuedFraction(double b0) : value_(b0 == 0 ? kTiny : b0), c_(value_) {}

  /// False when the term has not changed the value.
  bool add(double a, double b) {
    d_ = b + a * d_;
    if (d_ == 0) d_ = kTiny;
    d_ = 1 / d_;
    c_ = b + a / c_;
    if (c_ == 0) c_ = kTiny;
    const double change = c_ * d_;
    value_ *= change;
    return std::fabs(change - 1) > kPrecision;
  }
  double value() const { return value_; }

 private:
  double value_;
  double c_;
  double d_ = 0;
};

/// Upper regularised incomplete gamma function by its continued fraction, for x >= a + 1.
double gamma_fraction(double a, double x) {
  ContinuedFraction fraction(x + 1 - a);
  for (int n = 1; n < 10'000; ++n) {
    if (!fraction.add(-n * (n - a), x + 2 * n + 1 - a)) break;
  }
  return gamma_factor(a, x) / fraction.value();
}

/// ln (Gamma(a) Gamma(b) / Gamma(a+b)), without the cancellation of large logarithms.
double log_beta(double a, double b) {
  const double large = std::fmax(a, b);
  const double small = std::fmin(a, b);
  const double ratio = (large - 0.5) * log((large + small) / large) + small * log(large + small) -
                       small + stirling_rest(large + small) - stirling_rest(large);
  return log_gamma(small) - ratio;
}

/// Regularised incomplete beta function by its continued fraction, which converges fast for
/// x < (a+1)/(a+b+2). `y` is 1 - x.
double beta_fraction(double a, double b, double x, double y) {
  ContinuedFraction fraction(1);
  for (int m = 0; m < 10'000; ++m) {
    const double a2m = a + 2 * m;
    if (m > 0 && !fraction.add(m * (b - m) * x / ((a2m - 1) * a2m), 1)) break;
    if (!fraction.add(-(a + m) * (a + b + m) * x / (a2m * (a2m + 1)), 1)) break;
  }
  return exp(a * log(x) + b * log(y) - log_beta(a, b)) / (a * fraction.value());
}

/// Regularised incomplete beta function, by the fraction that converges.
double incomplete_beta(double a, double b, double x, double y) {
  if (x <= 0) return 0;
  if (y <= 0) return 1;
  if (x < (a + 1) / (a + b + 2)) return beta_fraction(a, b, x, y);
  return 1 - beta_fraction(b, a, y, x);
}

/// Cornish and Fisher's expansion of the t quantile about the normal one (Abramowitz and Stegun,
/// 26.7.5). The first omitted term is of order dof^-5.
double expanded_t_quantile(double z, double dof) {
  const double s = z * z;
  const double g1 = (s + 1) * z / 4;
  const double g2 = ((5 * s + 16) * s + 3) * z / 96;
  const double g3 = (((3 * s + 19) * s + 17) * s - 15) * z / 384;
  const double g4 = ((((79 * s + 776) * s + 1482) * s - 1920) * s - 945) * z / 92160;
  return z + (g1 + (g2 + (g3 + g4 / dof) / dof) / dof) / dof;
}

}  // namespace

double log_gamma(double x) {
  SWARMSMITH_ASSERT(x > 0, "the gamma function is asked for positive numbers only");
  return (x - 0.5) * log(x) - x + kHalfLogTwoPi + stirling_rest(x);
}

double chi_square_upper_tail(double x, double dof) {
  if (x <= 0) return 1;
  const double a = dof / 2;
  const double half = x / 2;
  return half < a + 1 ? 1 - gamma_series(a, half) : gamma_fraction(a, half);
}

double student_t_two_sided_tail(double t, double dof) {
  const double square = t * t;
  return incomplete_beta(dof / 2, 0.5, dof / (dof + square), square / (dof + square));
}

double student_t_upper_quantile(double upper_tail, double dof) {
  SWARMSMITH_ASSERT(upper_tail > 0 && upper_tail < 0.5 && dof >= 1,
                    "the tail is below one half, with one degree of freedom or more");
  const double z = -normal_quantile(upper_tail);
  // If the expansion is exact to double precision, it is the result.
  if (dof >= 1000 && z < 5) return expanded_t_quantile(z, dof);
  // Newton's method on the logarithm of the tail as a function of ln t, which is nearly a straight
  // line for thin and for thick tails.
  const double log_constant = -log_beta(dof / 2, 0.5) - 0.5 * log(dof);
  double t = dof < 3 ? 1 / (kPi * upper_tail) : std::fmax(expanded_t_quantile(z, dof), z);
  for (int i = 0; i < 100; ++i) {
    const double tail = 0.5 * student_t_two_sided_tail(t, dof);
    const double density = exp(log_constant - (dof + 1) / 2 * log(1 + t * t / dof));
    const double step = log(tail / upper_tail) * tail / (density * t);
    t *= exp(step);
    if (std::fabs(step) < 1e-14) break;
  }
  return t;
}

double StudentQuantiles::operator()(std::int64_t dof) {
  constexpr std::int64_t kKept = 1000;
  if (dof >= kKept) return student_t_upper_quantile(upper_tail_, static_cast<double>(dof));
  if (known_.empty()) known_.resize(kKept);
  double& quantile = known_[static_cast<std::size_t>(dof)];
  if (quantile == 0) quantile = student_t_upper_quantile(upper_tail_, static_cast<double>(dof));
  return quantile;
}

}  // namespace swarmsmith
