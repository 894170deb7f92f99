#pragma once

#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// The scatter of samples. A parabola in time is fitted by least squares through five consecutive
/// samples, and the middle sample is compared with it; the fit is symmetric, so steady motion
/// leaves no residual. The scatter comes from the median of the absolute residuals, so that turns
/// and bumps do not count as noise. It is at least `kLeastSigma`, and exactly that if there are too
/// few samples.
Scatter scatter_of(const std::vector<TimedPose>& track);

/// Ten times the localisation floor that was measured in section 6 of the tracking facts.
inline constexpr Scatter kLeastSigma{1e-4, 5e-4};

}  // namespace swarmsmith
