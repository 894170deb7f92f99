#pragma once

#include "base/rng.h"

namespace swarmsmith::irace {

/// A standard deviation below this counts as zero.
inline constexpr double kNoSpread = 2.2e-16;

/// A normal distribution truncated to [lower, upper], sampled by inversion. The two tail
/// probabilities are computed once, so that many draws from one distribution are cheap. The mean
/// may be outside the interval, even far outside.
class TruncatedNormal {
 public:
  TruncatedNormal(double mean, double sd, double lower, double upper);

  /// Draws one number from `rng`. With a standard deviation below kNoSpread the result is the mean.
  double sample(Rng& rng) const;

 private:
  double mean_;
  double sd_;
  double lower_;
  double upper_;
  /// Whether it is mirrored, so that it is computed in the lower tail, where probabilities keep
  /// their digits.
  bool mirrored_;
  double p_low_ = 0;  ///< probabilities of the mirrored and standardised ends
  double p_high_ = 1;
  double end_ = 0;  ///< the mirrored and standardised end next to the mean
};

}  // namespace swarmsmith::irace
