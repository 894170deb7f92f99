#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "sim/robot/rvr.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// Which part of the observations is the run.
struct RunSpan {
  std::vector<double>
      starts_s;    ///< the run's start on the clock of each camera of the observations
  int cycles = 0;  ///< control cycles of 0.1 s
  /// How long each camera ran, by another clock (RunVideo::length_s). Empty, or one a camera.
  std::vector<std::optional<double>> lengths_s;
};

/// Limits of tracking facts, sections 3, 4, 7, 8 and 10; the defaults are theirs.
struct TrackLimits {
  double top_speed_m_s = 1.0;
  double top_turn_rad_s = 10;
  double jump_m = 0.05;  ///< against the median of five samples
  /// At most; and at most two frames of the video's own rate, but always those of 0.15 s.
  double measured_gap_s = 0.2;
  double bridged_gap_s = 0.5;
  double degraded_gap_s = 1.0;
  double last_instant_gap_s = 0.2;  ///< at the end of a mission that is scored there
  double interpolated_share = 0.05;
  double outside_m = 0.15;        ///< beyond the walls
  double scale_tolerance = 0.03;  ///< of a tag: its height or edge is wrong
  double scale_warning = 0.01;  ///< what an edge measured to half a millimetre may be off by twice
  double scale_scatter = 0.05;  ///< of one sample from the others
  double residual_m = 0.0015;
  double least_frame_rate = 10;
  double dropped_share = 0.05;
  double moved_px = 1.0;  ///< of the floor tags: the camera moved
  /// The fastest that robots drive and turn: what `swarmsmith-robot` lets treads do at most, 0.147
  /// m apart. From the robots' logs where they are there.
  double driving_speed_m_s = 0.35;
  double driving_turn_rad_s = 4.8;
  bool knows_driving_speed = false;
};

struct TrackOptions {
  RunSpan span;
  std::vector<HandPoint> points;  ///< by hand
  std::vector<int> other_tags;    ///< that are expected in the picture: the tag of a sync event
  TrackLimits limits;
  Outline body = BoxOutline{kBodySide_m, kBodySide_m};  ///< of the robots: what may touch
  bool scored_at_the_end = false;       ///< the mission's score sees the last instant alone
  bool takes_tags_for_centres = false;  ///< where a robot has no offset
  bool corrects_height = true;          ///< false only to show what the error would be
};

/// The name of the check that doubts times which a recorder may have counted: another clock can
/// settle it.
inline constexpr const char* kClockOfTheFilm = "clock of the film";

/// From pixels to what the simulator would have recorded. Pure. Fails with E_ROBOT_MISSING (not
/// seen in the first 2 s; E_DUPLICATE_ID or E_VIDEO_TRUNCATED when that is why), E_NO_OFFSET,
/// E_CALIB_SIZE, or a rig without the cameras' calibrations; what makes a run invalid is an issue.
/// Does not depend on the order of the sightings.
Expected<TrackedRun> track_run(const Observations& observations, const Rig& rig, const Arena& arena,
                               const TrackOptions& asked);

}  // namespace swarmsmith
