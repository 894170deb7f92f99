#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/mission/pose.h"
#include "tracking/calibration/board_watch.h"
#include "tracking/overlay/draw_overlay.h"

namespace swarmsmith {

/// A robot as a camera sees it now.
struct LiveRobot {
  std::string name;
  int tag = 0;
  double height_m = 0;
  std::optional<Pose> pose;      ///< the latest, of its centre
  std::optional<double> seen_s;  ///< when that was, on the camera's clock
  bool is_seen = false;          ///< in this frame
  std::vector<Point> trail;      ///< of the last seconds, oldest first
};

/// What is known of one frame.
struct LiveState {
  std::int64_t frame = 0;
  double time_s = 0;  ///< of the camera's clock
  double frames_per_s = 0;
  double delay_s = 0;        ///< from having the frame to having the poses
  double most_delay_s = 0;   ///< of the last hundred frames
  std::int64_t dropped = 0;  ///< frames that were skipped, since newer ones were there
  /// How far the floor tags are from where the calibration of the camera's place saw them: the
  /// median over those seen in the last second.
  std::optional<double> camera_shift_px;
  std::optional<BoardProgress> board;  ///< while a board is shown to the camera
  int references_seen = 0;
  int references = 0;
  std::vector<LiveRobot> robots;
  std::vector<OverlayTag> tags;
  std::vector<std::string> issues;  ///< a sentence each
};

/// As one JSON object; lengths in metres, angles in radians, times in seconds.
std::string live_state_json(const LiveState& state);
/// "12.4 s, 30.0 frames/s, delay 8 ms (at most 14), robots 3 of 3, dropped 0", and the first issue.
std::string live_state_line(const LiveState& state);

}  // namespace swarmsmith
