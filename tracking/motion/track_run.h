#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "sim/robot/robot.h"
#include "sim/robot/rvr.h"
#include "tracking/motion/repeats.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// The part of the observations that is the run.
struct RunSpan {
  std::vector<double> starts_s;  ///< start of the run on the clock of each camera
  int cycles = 0;                ///< control cycles of 0.1 s
  /// How long each camera ran, measured with another clock (RunVideo::length_s). Empty, or one
  /// entry per camera.
  std::vector<std::optional<double>> lengths_s;
};

/// Limits from tracking facts, sections 3, 4, 7, 8 and 10, with their default values.
struct TrackLimits {
  double top_speed_m_s = 1.0;
  double top_turn_rad_s = 10;
  double jump_m = 0.05;  ///< distance from the median of five samples
  /// Longest gap that still counts as measured. It is reduced to two frames at the video's frame
  /// rate, but never below 0.15 s.
  double measured_gap_s = 0.2;
  double bridged_gap_s = 0.5;
  double degraded_gap_s = 1.0;
  double last_instant_gap_s = 0.2;  ///< at the end of a mission that is scored at its end
  double interpolated_share = 0.05;
  double outside_m = 0.15;        ///< distance beyond the walls
  double scale_tolerance = 0.03;  ///< error of a tag's scale: its height or edge is wrong
  double scale_warning = 0.01;    ///< twice the error of an edge measured to half a millimetre
  double scale_scatter = 0.05;    ///< difference of one sample's scale from the others
  double residual_m = 0.0015;
  double least_frame_rate = 10;
  double dropped_share = 0.05;
  double moved_px = 1.0;  ///< shift of the floor tags when the camera has moved
  /// The highest speeds at which robots drive and turn: the limits of `swarmsmith-robot` for treads
  /// 0.147 m apart, or the limits in the robots' logs if they exist.
  double driving_speed_m_s = 0.35;
  double driving_turn_rad_s = 4.8;
  bool knows_driving_speed = false;
  /// No corner of a tag is faster: driving, and turning that adds as much again.
  double corner_speed_m_s = kCornerSpeed_m_s;
};

/// Sets the limits for robots that drive and turn as fast as this. All limits on motion grow in the
/// same proportion; none becomes smaller than its default.
void allow_speed(TrackLimits& limits, double speed_m_s, double turn_rad_s);

/// The limits for such robots, and with this limit of speed in their logs (0: no logs). The motors
/// of an RVR could drive it faster than `swarmsmith-robot` lets them, so its own `max_speed`
/// changes nothing. That of a robot with another body or another `max_speed` does.
TrackLimits limits_of(const Robot& robot, double logged_m_s);

struct TrackOptions {
  RunSpan span;
  std::vector<HandPoint> points;  ///< marked by a person
  std::vector<int> other_tags;    ///< other expected tags, such as the tag of a sync event
  TrackLimits limits;
  Outline body = BoxOutline{kBodySide_m, kBodySide_m};  ///< of the robots, for finding contacts
  bool scored_at_the_end = false;       ///< the mission's score uses only the last instant
  bool takes_tags_for_centres = false;  ///< if a robot has no offset calibration
  bool corrects_height = true;          ///< false only to show the error without correction
};

/// The name of the check for frame times that a recorder may have counted without a clock. If the
/// robots' logs confirm the times, the check passes.
inline constexpr const char* kClockOfTheFilm = "clock of the film";

/// Converts sightings in pixels to what the simulator would have recorded. Pure. Fails with
/// E_ROBOT_MISSING if a robot was not seen in the first 2 s (E_DUPLICATE_ID or E_VIDEO_TRUNCATED if
/// that is the reason), E_NO_OFFSET, E_SPIN_QUALITY if a tag would sit outside of the
/// body, E_CALIB_SIZE, if the rig lacks a camera's calibrations, or if
/// a camera's readout or exposure takes longer than from one of its pictures to the next. Problems
/// that make a run invalid are issues. The result does not depend on the order of the sightings.
Expected<TrackedRun> track_run(const Observations& observations, const Rig& rig, const Arena& arena,
                               const TrackOptions& asked);

}  // namespace swarmsmith
