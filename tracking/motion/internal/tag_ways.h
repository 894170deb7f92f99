#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// Root mean square of how far the corners moved, pixels, to the thousandth that stores keep.
double corners_moved(const TagCorners& from, const TagCorners& to);

/// Faster than any corner of a tag: treads do 0.35 m/s, and as much again while the robot turns.
inline constexpr double kCornerSpeed_m_s = 0.7;

/// A robot's tag in one camera's frames.
struct TagWay {
  std::vector<const Sighting*> seen;  ///< one a frame; null where it was not seen, or twice
  std::vector<double> way;  ///< pixels that its corners went until a frame, as far as robots can
  double pixels_per_m = 0;  ///< median over the frames

  bool is_seen(std::size_t frame) const { return seen[frame] != nullptr; }
};

/// Of all robots that the camera saw; of several tags of one robot, the one that it saw most.
std::vector<TagWay> tag_ways(const Observations& observations, int camera,
                             std::span<const RobotSetup> robots);

/// Pixels a second along the way; 0 where the frames are at one instant.
inline double way_speed(const TagWay& tag, const std::vector<double>& times, std::size_t from,
                        std::size_t to) {
  return times[to] > times[from] ? (tag.way[to] - tag.way[from]) / (times[to] - times[from]) : 0;
}

/// The first frame that is not more than `span_s` before, the last not more than that after one.
std::size_t frame_before(const std::vector<double>& times, std::size_t frame, double span_s);
std::size_t frame_after(const std::vector<double>& times, std::size_t frame, double span_s);

}  // namespace swarmsmith
