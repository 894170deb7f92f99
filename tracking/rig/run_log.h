#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/instance_csv.h"
#include "sim/mission/mission.h"
#include "tracking/geometry/camera_model.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {

/// What a person knows of a trial and no camera can see: the run log (docs/tracking.md), a TOML
/// file, or flags of `track score`.

/// A video of the run, by one camera.
struct RunVideo {
  std::string camera;  ///< as in the rig; empty when there is only one
  std::string file;    ///< a video, a folder of images, a bag
  std::string times;   ///< sidecar with a time a frame; empty: FILE.times.csv if that is there
  double clock_ahead_s = 0;  ///< its clock minus that of the first video
  /// How long the camera ran, by another clock: shows a video that plays too fast.
  std::optional<double> length_s;

  friend bool operator==(const RunVideo&, const RunVideo&) = default;
};

/// When the run begins, on the clock of the first camera's frame times.
struct RunStart {
  std::optional<double> time_s;  ///< said by the log
  /// Else the instant at which this tag is hidden, or shown: a person does it when the robots are
  /// let go. Where the log says both, this one is a check.
  int sync_tag = 0;
  enum class Sync { None, Hidden, Shown } sync = Sync::None;

  friend bool operator==(const RunStart&, const RunStart&) = default;
};

/// Where the colour patches of the run come from.
struct RunLayout {
  enum class Source { None, Log, Measured } source = Source::None;
  std::vector<PatchPlacement> patches;  ///< of the log; of `Measured` those once measured

  friend bool operator==(const RunLayout&, const RunLayout&) = default;
};

/// Where a person saw a robot in a picture in which its tag was not found.
struct HandPoint {
  std::string robot;
  std::string camera;                 ///< empty when there is only one
  double time_s = 0;                  ///< of the run
  ImagePoint middle;                  ///< of its tag
  std::optional<double> heading_deg;  ///< of the robot; else as its neighbours say
  std::string who;

  friend bool operator==(const HandPoint&, const HandPoint&) = default;
};

/// What `swarmsmith-robot start` knows of a robot's node after the run.
struct RobotNote {
  std::string robot;
  std::string log;                 ///< the robot's own log, either of its two files; may be empty
  std::optional<Verdict> verdict;  ///< the node's
  std::vector<std::string> reasons;

  friend bool operator==(const RobotNote&, const RobotNote&) = default;
};

struct RunLog {
  std::string name;       ///< "run07"
  std::string recorded;   ///< date, "2026-11-21"
  Mission mission;        ///< without a name when the log does not say it
  std::string design;     ///< "d3", or empty
  std::string candidate;  ///< "c812", or empty: the design's winner
  std::string source = "real";
  std::vector<std::string> robots;  ///< that took part; empty: all of the rig
  RunStart start;
  RunLayout layout;
  std::vector<RunVideo> videos;
  std::vector<HandPoint> points;
  std::vector<RobotNote> notes;

  friend bool operator==(const RunLog&, const RunLog&) = default;
};

}  // namespace swarmsmith
