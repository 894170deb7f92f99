#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/mission/pose.h"
#include "tracking/calibration/board_watch.h"
#include "tracking/overlay/draw_overlay.h"

namespace swarmsmith {

/// A robot as the camera sees it now.
struct LiveRobot {
  std::string name;
  int tag = 0;
  double height_m = 0;
  std::optional<Pose> pose;      ///< latest pose of its centre
  std::optional<double> seen_s;  ///< time of this pose, on the camera's clock
  bool is_seen = false;          ///< its tag is in the current frame
  std::vector<Point> trail;      ///< positions in the last seconds, oldest first
};

/// The results from one frame.
struct LiveState {
  std::int64_t frame = 0;
  double time_s = 0;  ///< time on the camera's clock
  double frames_per_s = 0;
  double delay_s = 0;        ///< from the arrival of the frame to its poses
  double most_delay_s = 0;   ///< largest delay of the last hundred frames
  std::int64_t dropped = 0;  ///< frames that were skipped because a newer one had arrived
  /// The distance of the floor tags from their positions in the calibration of the camera's place:
  /// the median over the tags seen in the last second.
  std::optional<double> camera_shift_px;
  std::optional<BoardProgress> board;  ///< if the camera films a calibration board
  int references_seen = 0;
  int references = 0;
  std::vector<LiveRobot> robots;
  std::vector<OverlayTag> tags;
  std::vector<std::string> issues;  ///< one sentence each
};

/// The state as a JSON object; lengths in metres, angles in radians, times in seconds.
std::string live_state_json(const LiveState& state);
/// The state as one line, with the first issue: "12.4 s, 30.0 frames/s, delay 8 ms (at most 14),
/// robots 3 of 3, dropped 0".
std::string live_state_line(const LiveState& state);

}  // namespace swarmsmith
