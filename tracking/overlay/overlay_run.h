#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/mission/mission.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// A robot at one time of a run.
struct OverlayRobot {
  std::string name;
  Pose pose;            ///< of its centre
  double height_m = 0;  ///< of its tag
  CycleKind kind = CycleKind::Measured;
  std::vector<Point> trail;  ///< of its centre, oldest first, up to now
};

/// What there is to be seen at one time of a run.
struct OverlayMoment {
  double time_s = 0;  ///< of the run; negative before it
  std::vector<OverlayRobot> robots;
  std::optional<double> score;      ///< of what was until now
  std::vector<double> tile_ages_s;  ///< row by row, of a mission that scores coverage
  std::vector<std::string> issues;  ///< that concern this time: "E_GAP rvr2: ..."
};

/// A run as moments.
class OverlayRun {
 public:
  /// `mission` with the patches of the run in its arena; `issues`: those of scoring, or of
  /// tracking.
  OverlayRun(const TrackedRun& run, const Rig& rig, Mission mission, std::vector<Issue> issues);

  /// Between cycles poses are interpolated, the score is that of the last cycle. There are no
  /// robots before the run; after it they stay where they ended.
  OverlayMoment at(double time_s) const;
  double duration_s() const;
  const Mission& mission() const { return mission_; }

 private:
  struct Robot {
    std::string name;
    double height_m = 0;
    std::vector<Pose> poses;  ///< one a cycle, that of the start first
    std::vector<CycleKind> kinds;
  };

  Mission mission_;
  std::vector<Robot> robots_;
  std::vector<double> scores_;            ///< after each cycle
  std::vector<std::vector<int>> visits_;  ///< a tile: the cycles in which it held a robot
  std::vector<Issue> issues_;
  int cycles_ = 0;
};

}  // namespace swarmsmith
