#pragma once

#include <vector>

#include "analysis/drawing/svg.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// From the arena's plane (metres, y up) to the page (millimetres, y down).
class ArenaView {
 public:
  /// Fits all that stands in the arena, and its lights, into the width and at most the height; its
  /// upper edge is at `top_mm`.
  ArenaView(const Arena& arena, double left_mm, double top_mm, double width_mm, double height_mm);

  PagePoint at(Point point) const;
  double length(double metres) const { return metres * scale_; }
  double scale() const { return scale_; }  ///< mm on the page a metre
  double bottom() const { return bottom_; }

  std::vector<PagePoint> walls(const Arena& arena) const;
  /// An outline at a pose; circles as polygons with so many corners that they look round.
  std::vector<PagePoint> outline(const Outline& outline, const Pose& pose) const;
  /// A place in the frame of something at a pose.
  PagePoint on(const Pose& pose, Point place) const;
  std::vector<PagePoint> track(const std::vector<Pose>& poses) const;

 private:
  double scale_ = 1;
  double left_ = 0;
  double top_ = 0;
  double bottom_ = 0;
  Point corner_;  ///< of the arena's box, upper left, metres
};

/// Corners of an outline in its own frame.
std::vector<Point> corners_of(const Outline& outline);

}  // namespace swarmsmith
