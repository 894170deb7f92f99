#pragma once

#include "base/expected.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// Number of consecutive frames a tag must be missing (or visible) before it counts as hidden (or
/// shown); shorter changes are flicker of the detector.
inline constexpr std::size_t kSyncFrames = 3;

/// The time when the tag of a sync event was hidden (or shown), on the clock of camera `camera` of
/// the observations. It is half way between the last frame before the change and the first frame
/// after it, so the error is at most half a frame. E_CONFIG if this never happened, or more than
/// once (with the times); then `start` must give the time.
Expected<double> sync_instant(const Observations& observations, int camera, const RunStart& start);

}  // namespace swarmsmith
