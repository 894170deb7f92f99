#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// Root mean square of the movement of the corners, in pixels, rounded to 1/1000 as in stores.
double corners_moved(const TagCorners& from, const TagCorners& to);

/// The motion of a robot's tag in the frames of one camera.
struct TagWay {
  std::vector<const Sighting*> seen;  ///< per frame; null if not seen, or seen twice
  std::vector<double> way;  ///< pixels its corners moved until each frame, limited to robots' speed
  double pixels_per_m = 0;  ///< median over the frames
  double corner_speed_m_s = 0;  ///< the most

  bool is_seen(std::size_t frame) const { return seen[frame] != nullptr; }
};

/// The motion of all robots that the camera saw; for a robot with several tags, of the tag that was
/// seen most often.
std::vector<TagWay> tag_ways(const Observations& observations, int camera,
                             std::span<const RobotSetup> robots, double corner_speed_m_s);

/// Mean speed between two frames in pixels per second; 0 if both have the same time.
inline double way_speed(const TagWay& tag, const std::vector<double>& times, std::size_t from,
                        std::size_t to) {
  return times[to] > times[from] ? (tag.way[to] - tag.way[from]) / (times[to] - times[from]) : 0;
}

/// The first frame that is at most `span_s` before a frame, and the last frame that is at most
/// `span_s` after it.
std::size_t frame_before(const std::vector<double>& times, std::size_t frame, double span_s);
std::size_t frame_after(const std::vector<double>& times, std::size_t frame, double span_s);

}  // namespace swarmsmith
