#include "irace_core/internal/distributions.h"

#include <algorithm>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith::irace {
namespace {
constexpr double kVanishing = 1e-290;  // below this, probabilities lose digits
}  // namespace

TruncatedNormal::TruncatedNormal(double mean, double sd, double lower, double upper)
    : mean_(mean), sd_(sd), lower_(lower), upper_(upper), mirrored_(lower + upper > 2 * mean) {
  SWARMSMITH_ASSERT(lower_ <= upper_ && sd_ >= 0, "draws lie between a lower and an upper end");
  if (sd_ < kNoSpread) return;
  const double a = (lower - mean) / sd;
  const double b = (upper - mean) / sd;
  end_ = mirrored_ ? -a : b;
  p_low_ = normal_cdf(mirrored_ ? -b : a);
  p_high_ = normal_cdf(end_);
}

double TruncatedNormal::sample(Rng& rng) const {
  const double u = (static_cast<double>(rng.next() >> 11U) + 0.5) * 0x1.0p-53;
  if (sd_ < kNoSpread) return mean_;
  // This far out, the tail falls off like an exponential from the end that is next to the mean.
  const double z = p_high_ > kVanishing ? normal_quantile(p_low_ + u * (p_high_ - p_low_))
                                        : end_ + log(u) / -end_;
  const double x = mirrored_ ? mean_ - sd_ * z : mean_ + sd_ * z;
  return std::clamp(x, lower_, upper_);
}

}  // namespace swarmsmith::irace
