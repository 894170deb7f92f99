#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// The run log for `swarmsmith track` (docs/tracking.md), as `start` knows it: a person need not
/// type a start time. Pure.

/// How a recording's times hang together with the clock of the host that made it.
struct CameraClock {
  double first_time_s = 0;   ///< of the first frame, as the video counts
  double first_clock_s = 0;  ///< CLOCK_MONOTONIC of the host at the same instant
  double last_clock_s = 0;   ///< of the last frame that is there
};

/// From the sidecar of `swarmsmith track record`, FILE.times.csv, or FILE.times.csv.part while it
/// records. BadInput when it has no `clock_s`, as of anything but a camera, or no frame.
Expected<CameraClock> camera_clock_of(std::string_view sidecar, const std::string& file);

/// A robot's node after the run.
struct NodeReport {
  std::string robot;
  std::string log;                    ///< its log, from the run log's folder on; empty: not known
  std::optional<RunVerdict> verdict;  ///< none: it was never heard of again
  std::vector<std::string> reasons;
};

/// A run that the operator started, on the host that records.
struct StartedRun {
  std::string run;        ///< "run07"
  std::string recorded;   ///< date, "2026-11-21"
  std::string mission;    ///< a built-in one, or a file from the run log's folder on; may be empty
  std::string design;     ///< "d3"; may be empty
  std::string candidate;  ///< "c812"; may be empty, as is one of these two
  bool has_patches = false;     ///< shuffled for each run: to be found in the pictures
  double at_clock_s = 0;        ///< CLOCK_MONOTONIC of the operator's host when the robots began
  std::string video;            ///< from the run log's folder on; empty: none was named
  std::string camera;           ///< as in the arena file; may be empty
  std::optional<int> sync_tag;  ///< that a person covers at the start: a check
  std::vector<NodeReport> nodes;
};

/// A file for `swarmsmith track score --run`, and what a person should know of it.
struct TrackLog {
  std::string text;
  std::vector<std::string> warnings;
};

/// The start is on the video's times: at_clock_s - first_clock_s + first_time_s. Where the clock is
/// missing, or the recording cannot have seen the start, the file says so in place of the start.
TrackLog track_log_of(const StartedRun& run, const std::optional<CameraClock>& clock);

}  // namespace swarmsmith
