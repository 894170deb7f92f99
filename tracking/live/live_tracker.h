#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "tracking/detection/tag_search.h"
#include "tracking/live/live_state.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// Poses from one camera, frame by frame, by nothing but the frames so far. Nothing is smoothed or
/// dropped: what counts is what `track score` makes of the whole recording.
class LiveTracker {
 public:
  /// BadInput for an unknown tag family. A rig without calibrations shows tags alone. `arena`: to
  /// tell when a robot is outside of it.
  static Expected<LiveTracker> of(Rig rig, CameraSetup camera, std::optional<Arena> arena);

  /// Times increase. Delay and dropped frames are for who knows the clock.
  LiveState look_at(const GrayImage& image, std::int64_t frame, double time_s);
  const std::optional<View>& view() const { return view_; }

 private:
  LiveTracker(TagSearch search, Rig rig, CameraSetup camera, std::optional<Arena> arena);
  void place(std::size_t robot, const std::vector<Detection>& seen, double time_s,
             LiveState& state);
  void note_floor_tag(const Detection& seen, double time_s);
  std::optional<double> camera_shift(double time_s);
  void add_issues(const std::vector<Detection>& seen, LiveState& state) const;

  struct Known {
    std::optional<Pose> pose;
    std::optional<double> seen_s;
    std::deque<std::pair<double, Point>> trail;
    double scale = 1;
  };

  TagSearch search_;
  Rig rig_;
  CameraSetup camera_;
  std::optional<Arena> arena_;
  std::optional<View> view_;
  std::vector<Known> known_;        ///< a robot
  std::deque<double> frame_times_;  ///< of the last two seconds
  /// Looks of the last second of floor tags that the calibration of the place knows.
  std::map<int, std::deque<std::pair<double, TagCorners>>> floor_looks_;
  std::map<int, TagCorners> calibrated_;
  std::map<int, double> references_seen_s_;
};

}  // namespace swarmsmith
