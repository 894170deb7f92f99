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

/// Computes poses from one camera frame by frame, using only the frames so far. Poses are not
/// smoothed, and outliers are not dropped; the results that count come from `track score` on the
/// complete recording.
class LiveTracker {
 public:
  /// BadInput for an unknown tag family. Without calibrations, only tags are shown. `arena` is used
  /// to warn when a robot leaves it.
  static Expected<LiveTracker> of(Rig rig, CameraSetup camera, std::optional<Arena> arena);

  /// Times must increase. The caller, who has the clock, fills in the delay and the dropped frames.
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
  std::vector<Known> known_;        ///< one per robot
  std::deque<double> frame_times_;  ///< frame times of the last two seconds
  /// The sightings in the last second of floor tags that are in the calibration of the place.
  std::map<int, std::deque<std::pair<double, TagCorners>>> floor_looks_;
  std::map<int, TagCorners> calibrated_;
  std::map<int, double> references_seen_s_;
};

}  // namespace swarmsmith
