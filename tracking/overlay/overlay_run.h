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
  Pose pose;            ///< pose of its centre
  double height_m = 0;  ///< height of its tag
  CycleKind kind = CycleKind::Measured;
  std::vector<Point> trail;  ///< positions of its centre until now, oldest first
};

/// Everything that an overlay shows at one time of a run.
struct OverlayMoment {
  double time_s = 0;  ///< time of the run; negative before its start
  std::vector<OverlayRobot> robots;
  std::optional<double> score;      ///< score of the run until now
  std::vector<double> tile_ages_s;  ///< row by row, for a mission that scores coverage
  std::vector<std::string> issues;  ///< issues of this time: "E_GAP rvr2: ..."
};

/// A run as a sequence of moments.
class OverlayRun {
 public:
  /// `mission` has the patches of the run in its arena; `issues` are from scoring or from tracking.
  OverlayRun(const TrackedRun& run, const Rig& rig, Mission mission, std::vector<Issue> issues);

  /// Between two cycles, poses are interpolated, and the score is that of the earlier cycle. Before
  /// the run there are no robots; after it they stay at their last poses.
  OverlayMoment at(double time_s) const;
  double duration_s() const;
  const Mission& mission() const { return mission_; }

 private:
  struct Robot {
    std::string name;
    double height_m = 0;
    std::vector<Pose> poses;  ///< one per cycle, beginning with the start
    std::vector<CycleKind> kinds;
  };

  Mission mission_;
  std::vector<Robot> robots_;
  std::vector<double> scores_;            ///< after each cycle
  std::vector<std::vector<int>> visits_;  ///< per tile: the cycles in which a robot was on it
  std::vector<Issue> issues_;
  int cycles_ = 0;
};

}  // namespace swarmsmith
