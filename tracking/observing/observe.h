#pragma once

#include <functional>
#include <set>
#include <string>

#include "base/expected.h"
#include "tracking/detection/tag_search.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A video to look at, opened.
struct ObservedVideo {
  CameraSetup camera;
  FrameSource& source;
  FrameClock clock;
  std::string sha256;
};

struct ObserveOptions {
  std::string family = "tag36h11";
  TagSearchOptions search;
  std::set<int> references;     ///< floor tags, kept as medians and not as sightings; lie still
  double reference_span_s = 1;  ///< that a median is taken over
};

/// Is called after each frame: how many are done, of how many (0: not known), and what was seen.
using OnFrame =
    std::function<void(std::int64_t done, std::int64_t of, const std::vector<Detection>& seen)>;

/// When a camera saw a row of a frame: the middle of its exposure. A stamp speaks of the first row;
/// `v` / `rows` of the readout later is the one at `v` (tracking facts, section 4).
double exposed_at(const CameraSetup& camera, double stamp_s, double v, int rows);

/// What one camera saw from the first frame to the last, with its sightings in order. Fails when
/// the video cannot be read at all, is mirrored, or its times cannot be trusted; a video that
/// breaks off is a record with E_VIDEO_TRUNCATED. Frames that were dropped are found by their
/// times, not here. A picture that is bit for bit that of the frame before has that frame's corners
/// again.
Expected<CameraObservations> observe(ObservedVideo video, const ObserveOptions& options,
                                     const OnFrame& on_frame = {});

}  // namespace swarmsmith
