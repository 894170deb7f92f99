#pragma once

#include "base/rng.h"

namespace swarmsmith::irace {

/// A smaller standard deviation is none.
inline constexpr double kNoSpread = 2.2e-16;

/// A normal distribution given that it lies in [lower, upper], sampled by inversion. The two tail
/// probabilities are computed once, so that many draws from one distribution are cheap. The mean
/// may lie outside of the interval, even far out.
class TruncatedNormal {
 public:
  TruncatedNormal(double mean, double sd, double lower, double upper);

  /// One number is drawn. A standard deviation below kNoSpread gives the mean.
  double sample(Rng& rng) const;

 private:
  double mean_;
  double sd_;
  double lower_;
  double upper_;
  bool mirrored_;     ///< computed in the lower tail, where probabilities keep their digits
  double p_low_ = 0;  ///< of the mirrored and standardised ends
  double p_high_ = 1;
  double end_ = 0;  ///< the mirrored and standardised end next to the mean
};

}  // namespace swarmsmith::irace
