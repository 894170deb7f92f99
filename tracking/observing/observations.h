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

/// What the cameras saw, in pixels: all that is measured. Poses, cycles and scores follow from it
/// and the calibrations by pure functions, so that a run can be scored again when a calibration was
/// mended (decision 17).

/// A tag in a frame.
struct Sighting {
  int camera = 0;          ///< number in the list of cameras
  std::int64_t frame = 0;  ///< its place in the camera's frame_times
  double time_s = 0;       ///< of the camera's clock, middle of the exposure of the tag's rows
  int tag = 0;
  TagCorners corners{};
  int hamming = 0;    ///< bits corrected
  double margin = 0;  ///< decision margin of the detector

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// Where the floor tags were within one span of some seconds: medians over its frames.
struct ReferenceLook {
  double time_s = 0;  ///< the span's middle
  int tag = 0;
  TagCorners corners{};
  int frames = 0;
};

/// One camera's recording.
struct CameraRecord {
  std::string camera;
  std::string file;
  std::string sha256;  ///< of the file; of a folder, over its files' names and bytes
  ImageSize size;
  std::int64_t frames = 0;
  std::int64_t damaged_frames = 0;  ///< that the decoder gave up
  TimeSource time_source = TimeSource::Container;
  std::vector<double> frame_times;  ///< camera's clock, one a frame, increasing
  std::vector<ReferenceLook> references;
};

/// What one camera saw, from its first frame to its last.
struct CameraObservations {
  CameraRecord record;
  std::vector<Sighting> sightings;  ///< by frame, tag; camera number 0
  std::vector<Issue> issues;
};

/// What a robot wrote down itself. From a store, rows have neither readings nor time stamps.
struct RobotLog {
  std::string robot;  ///< as in the rig
  std::string file;
  RunRecord record;
  /// Of a log from a store: what followed from the readings when they were at hand.
  std::optional<NeighboursSeen> neighbours = {};
};

struct Observations {
  std::vector<CameraRecord> cameras;
  std::vector<Sighting> sightings;  ///< by camera, frame, tag; robots' and unknown tags alike
  std::vector<RobotLog> logs;       ///< of this run; robots without one are not there
  std::vector<Issue> issues;        ///< of files and times
};

/// Several cameras' observations as those of one run.
Observations joined_observations(std::vector<CameraObservations> cameras);

}  // namespace swarmsmith
