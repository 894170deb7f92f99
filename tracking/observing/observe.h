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

/// A video that was opened for observing.
struct ObservedVideo {
  CameraSetup camera;
  FrameSource& source;
  FrameClock clock;
  std::string sha256;
};

struct ObserveOptions {
  std::string family = "tag36h11";
  TagSearchOptions search;
  std::set<int> references;     ///< floor tags; kept as medians and not as sightings
  double reference_span_s = 1;  ///< length of the spans for these medians
};

/// Called after each frame with the number of frames done, the total number (0: unknown), and the
/// tags seen.
using OnFrame =
    std::function<void(std::int64_t done, std::int64_t of, const std::vector<Detection>& seen)>;

/// The time at which a camera saw a row of a frame: the middle of the row's exposure. A time stamp
/// belongs to the first row; the row at `v` is read out later by the share `v` / `rows` of the
/// readout time (tracking facts, section 4).
double exposed_at(const CameraSetup& camera, double stamp_s, double v, int rows);

/// Observes a video from the first frame to the last; sightings are in order. Fails if the video
/// cannot be read at all, is mirrored, or has unreliable times; a video that ends early gives a
/// record with E_VIDEO_TRUNCATED. Dropped frames are not detected here, but later from their times.
/// A picture that is bit for bit equal to the previous one gets the corners of the previous one.
Expected<CameraObservations> observe(ObservedVideo video, const ObserveOptions& options,
                                     const OnFrame& on_frame = {});

}  // namespace swarmsmith
