#pragma once

#include "base/expected.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// Frames that a tag must be gone, or there, before it counts as hidden, or shown; fewer are a
/// flicker of the detector.
inline constexpr std::size_t kSyncFrames = 3;

/// When the tag of a sync event was hidden, or shown, on the clock of camera `camera` of the
/// observations: between the last frame before and the first frame after, at the middle, so that it
/// is half a frame off at most. E_CONFIG when it never was, and when it was more than once, with
/// the times: then `start` must say it.
Expected<double> sync_instant(const Observations& observations, int camera, const RunStart& start);

}  // namespace swarmsmith
