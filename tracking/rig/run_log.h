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

/// The facts about a real run that a person knows and a camera cannot see: the run log
/// (docs/tracking.md), a TOML file or options of `track score`.

/// A video of the run, filmed by one camera.
struct RunVideo {
  std::string camera;        ///< its name in the rig; empty if there is only one
  std::string file;          ///< a video, a folder of images, a bag
  std::string times;         ///< sidecar with the frame times; empty: FILE.times.csv if it exists
  double clock_ahead_s = 0;  ///< its clock minus that of the first video
  /// How long the camera ran, by another clock. It reveals a video that plays too fast.
  std::optional<double> length_s;

  friend bool operator==(const RunVideo&, const RunVideo&) = default;
};

/// When the run begins, on the clock of the first camera's frame times.
struct RunStart {
  std::optional<double> time_s;  ///< the start that the log gives
  /// Otherwise the run starts when this tag is hidden (or shown): a person covers or uncovers it
  /// when the robots are released. If the log also gives a time, the tag only checks it.
  int sync_tag = 0;
  enum class Sync { None, Hidden, Shown } sync = Sync::None;

  friend bool operator==(const RunStart&, const RunStart&) = default;
};

/// The source of the positions of the run's colour patches.
struct RunLayout {
  enum class Source { None, Log, Measured } source = Source::None;
  std::vector<PatchPlacement> patches;  ///< from the log; for `Measured`, once measured

  friend bool operator==(const RunLayout&, const RunLayout&) = default;
};

/// The place of a robot that a person marked in a picture in which its tag was not found.
struct HandPoint {
  std::string robot;
  std::string camera;                 ///< empty when there is only one
  double time_s = 0;                  ///< seconds since the start of the run
  ImagePoint middle;                  ///< centre of its tag
  std::optional<double> heading_deg;  ///< heading of the robot; if absent, interpolated
  std::string who;

  friend bool operator==(const HandPoint&, const HandPoint&) = default;
};

/// The notes of `swarmsmith-robot start` on a robot's node after the run.
struct RobotNote {
  std::string robot;
  std::string log;                 ///< the robot's own log, one of its two files; may be empty
  std::optional<Verdict> verdict;  ///< the verdict of the node
  std::vector<std::string> reasons;

  friend bool operator==(const RobotNote&, const RobotNote&) = default;
};

struct RunLog {
  std::string name;       ///< "run07"
  std::string recorded;   ///< date, "2026-11-21"
  Mission mission;        ///< without a name if the log does not give one
  std::string design;     ///< "d3", or empty
  std::string candidate;  ///< "c812"; if empty, the design's winner ran
  std::string source = "real";
  std::vector<std::string> robots;  ///< the robots that took part; empty: all robots of the rig
  RunStart start;
  RunLayout layout;
  std::vector<RunVideo> videos;
  std::vector<HandPoint> points;
  std::vector<RobotNote> notes;

  friend bool operator==(const RunLog&, const RunLog&) = default;
};

}  // namespace swarmsmith
