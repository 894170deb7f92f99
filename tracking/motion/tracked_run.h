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

/// A robot's centre at one instant, from one sighting, or from those of several tags of its in one
/// picture.
struct Sample {
  double time_s = 0;  ///< of the run: 0 is its start
  int camera = 0;
  std::int64_t frame = 0;
  Pose pose;
  double scale = 1;       ///< of the tag, TagPose
  double residual_m = 0;  ///< of the tag, TagPose
  enum class Use { Used, Outlier, Duplicate, BadFit, Outside } use = Use::Used;
  std::size_t sighting = 0;  ///< that it was made of, by its number in the observations
  std::vector<std::size_t> more_sightings = {};  ///< of the robot's other tags
};

/// How a robot's pose at a control cycle was obtained.
enum class CycleKind : std::int8_t {
  Measured = 0,      ///< between neighbours at most two frames apart, and 0.2 s
  Interpolated = 1,  ///< across a gap of at most 0.5 s
  Degraded = 2,      ///< across a gap of at most 1 s
  Missing = 3        ///< nothing to interpolate between: the pose is the last known one
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
  bool has_heading = false;       ///< a straight run told how its tag is turned on it
  std::vector<Sample> samples;    ///< by time
  std::vector<CycleKind> cycles;  ///< one a control cycle, from 0.1 s on
  std::vector<Scatter> sigmas;    ///< of each cycle's pose: the wider the gap, the larger
  double longest_gap_s = 0;
  double longest_gap_from_s = 0;
  int outliers = 0;
  double mean_scale = 1;
  double mean_residual_m = 0;
  Scatter sigma;  ///< of one camera's sample, estimated
};

/// A run as the simulator would have recorded it, and how it was obtained.
struct TrackedRun {
  std::vector<Pose> starts;  ///< at 0 s
  Trajectory trajectory;     ///< at 0.1 s, 0.2 s, ...: the instants that scores see
  std::vector<TrackedRobot> robots;
  double covered_s = 0;  ///< of the run by the videos
  double frame_rate_least = 0;
  double frame_rate_median = 0;
  double frame_rate_most = 0;
  std::int64_t frames = 0;
  std::int64_t frames_dropped = 0;
  std::int64_t frames_twice = 0;  ///< the same picture again
  std::vector<Issue> issues;
  std::vector<Check> checks;  ///< all that were asked, and those that could not be
};

}  // namespace swarmsmith
