#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mission/trajectory.h"
#include "tracking/rig/check.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {

/// A robot's centre at one instant, from one sighting, or from the sightings of several of its tags
/// in one picture.
struct Sample {
  double time_s = 0;  ///< time of the run: 0 is its start
  int camera = 0;
  std::int64_t frame = 0;
  Pose pose;
  double scale = 1;       ///< scale of the tag (TagPose)
  double residual_m = 0;  ///< residual of the tag (TagPose)
  enum class Use { Used, Outlier, Duplicate, BadFit, Outside } use = Use::Used;
  std::size_t sighting = 0;                      ///< index of its sighting in the observations
  std::vector<std::size_t> more_sightings = {};  ///< sightings of the robot's other tags
};

/// How a robot's pose at a control cycle was obtained.
enum class CycleKind : std::int8_t {
  Measured = 0,      ///< between samples at most two frames and at most 0.2 s apart
  Interpolated = 1,  ///< across a gap of at most 0.5 s
  Degraded = 2,      ///< across a gap of at most 1 s
  Missing = 3        ///< no interpolation possible: the last known pose
};

std::string_view name_of(CycleKind kind);

/// One standard deviation of a coordinate and of the heading.
struct Scatter {
  double sigma_m = 0;
  double sigma_rad = 0;
};

/// One robot's part of a run.
struct TrackedRobot {
  std::string name;
  int tag = 0;
  bool has_heading = false;       ///< a straight run showed the direction of its tag
  std::vector<Sample> samples;    ///< sorted by time
  std::vector<CycleKind> cycles;  ///< one per control cycle, from 0.1 s on
  std::vector<Scatter> sigmas;    ///< of each cycle's pose; larger in wider gaps
  double longest_gap_s = 0;
  double longest_gap_from_s = 0;
  int outliers = 0;
  double mean_scale = 1;
  double mean_residual_m = 0;
  Scatter sigma;  ///< estimate for one camera's sample
};

/// A run as the simulator would have recorded it, and how it was obtained.
struct TrackedRun {
  std::vector<Pose> starts;  ///< at 0 s
  Trajectory trajectory;     ///< at 0.1 s, 0.2 s, ...: the instants at which scores are computed
  std::vector<TrackedRobot> robots;
  double covered_s = 0;  ///< time of the run that the videos cover
  double frame_rate_least = 0;
  double frame_rate_median = 0;
  double frame_rate_most = 0;
  std::int64_t frames = 0;
  std::int64_t frames_dropped = 0;
  std::int64_t frames_twice = 0;  ///< frames that repeat the picture before them
  std::vector<Issue> issues;
  std::vector<Check> checks;  ///< all checks, including those that could not be done
};

}  // namespace swarmsmith
