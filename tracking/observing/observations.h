#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "robot/runtime/run_record.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/observing/neighbours_seen.h"
#include "tracking/rig/issue.h"
#include "tracking/rig/time_source.h"

namespace swarmsmith {

/// The observations of the cameras, in pixels: the only measured data. Poses, cycles and scores are
/// computed from them and from the calibrations by pure functions, so that a run can be scored
/// again after a calibration was corrected (decision 17).

/// A tag in a frame.
struct Sighting {
  int camera = 0;          ///< index in the list of cameras
  std::int64_t frame = 0;  ///< index in the camera's frame_times
  double time_s = 0;       ///< camera's clock at the middle of the exposure of the tag's rows
  int tag = 0;
  TagCorners corners{};
  int hamming = 0;    ///< number of corrected bits
  double margin = 0;  ///< decision margin of the detector

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// The corners of a floor tag in a span of some seconds: medians over its frames.
struct ReferenceLook {
  double time_s = 0;  ///< middle of the span
  int tag = 0;
  TagCorners corners{};
  int frames = 0;
};

/// One camera's recording.
struct CameraRecord {
  std::string camera;
  std::string file;
  std::string sha256;  ///< of the file; for a folder, over the names and contents of its files
  ImageSize size;
  std::int64_t frames = 0;
  std::int64_t damaged_frames = 0;  ///< frames that could not be decoded
  TimeSource time_source = TimeSource::Container;
  std::vector<double> frame_times;  ///< on the camera's clock, one per frame, increasing
  std::vector<ReferenceLook> references;
};

/// The observations of one camera, from its first frame to its last.
struct CameraObservations {
  CameraRecord record;
  std::vector<Sighting> sightings;  ///< sorted by frame and tag; the camera index is 0
  std::vector<Issue> issues;
};

/// A robot's own log of a run. Rows from a store have neither readings nor time stamps.
struct RobotLog {
  std::string robot;  ///< as in the rig
  std::string file;
  RunRecord record;
  /// Only for a log from a store: the result that was computed when the readings were available.
  std::optional<NeighboursSeen> neighbours = {};
};

struct Observations {
  std::vector<CameraRecord> cameras;
  std::vector<Sighting> sightings;  ///< by camera, frame, tag; includes unknown tags
  std::vector<RobotLog> logs;       ///< logs of this run; robots without a log are missing
  std::vector<Issue> issues;        ///< issues of files and times
};

/// Joins the observations of several cameras into those of one run.
Observations joined_observations(std::vector<CameraObservations> cameras);

}  // namespace swarmsmith
