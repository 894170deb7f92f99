#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// The run log for `swarmsmith track` (docs/tracking.md) with the data that `start` has, so
/// that users need not enter a start time. Pure.

/// The relation between the times of a recording and the clock of the host that made it.
struct CameraClock {
  double first_time_s = 0;   ///< of the first frame, in the time of the video
  double first_clock_s = 0;  ///< CLOCK_MONOTONIC of the host at the same instant
  double last_clock_s = 0;   ///< of the last frame so far
};

/// Reads the sidecar of `swarmsmith track record`, FILE.times.csv, or FILE.times.csv.part during
/// the recording. BadInput if there is no frame or no column `clock_s`, which only sidecars of
/// cameras have.
Expected<CameraClock> camera_clock_of(std::string_view sidecar, const std::string& file);

/// The report of a robot's node after the run.
struct NodeReport {
  std::string robot;
  std::string log;                    ///< its log, relative to the run log's folder; empty: not
                                      ///< known
  std::optional<RunVerdict> verdict;  ///< none: there was no message from it after the run
  std::vector<std::string> reasons;
};

/// A run that the operator started, on the same host as the recording.
struct StartedRun {
  std::string run;        ///< "run07"
  std::string recorded;   ///< date, such as "2026-11-21"
  std::string mission;    ///< a built-in mission, or a file relative to the run log's folder; may
                          ///< be empty
  std::string design;     ///< "d3"; may be empty
  std::string candidate;  ///< "c812"; may be empty; at most one of design and candidate is given
  bool has_patches = false;     ///< shuffled for each run, so that they must be found in the
                                ///< pictures
  double at_clock_s = 0;        ///< CLOCK_MONOTONIC of the operator's host when the robots started
  std::string video;            ///< relative to the run log's folder; empty: none was named
  std::string camera;           ///< as in the arena file; may be empty
  std::optional<int> sync_tag;  ///< tag that a person covers at the start, as a check
  std::vector<NodeReport> nodes;
};

/// A file for `swarmsmith track score --run`, with remarks for the user.
struct TrackLog {
  std::string text;
  std::vector<std::string> warnings;
};

/// The start in the time of the video is at_clock_s - first_clock_s + first_time_s. If the clock is
/// missing, or the recording cannot contain the start, the file says so instead of giving a start.
TrackLog track_log_of(const StartedRun& run, const std::optional<CameraClock>& clock);

}  // namespace swarmsmith
