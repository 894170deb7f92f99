#pragma once

#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// How much samples scatter. From what the middle of five samples in a row differs from the
/// parabola through them by least squares in time; symmetric, so that steady motion leaves nothing.
/// Medians of the absolute residuals, so that turns and bumps do not count as noise. At least
/// `kLeastSigma`; that alone when there are too few samples.
Scatter scatter_of(const std::vector<TimedPose>& track);

/// The localisation floor of section 6 times ten, as was measured there.
inline constexpr Scatter kLeastSigma{1e-4, 5e-4};

}  // namespace swarmsmith
