#pragma once

#include <vector>

#include "analysis/drawing/svg.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// Maps the arena's plane (metres, y up) to the page (millimetres, y down).
class ArenaView {
 public:
  /// Fits the arena, with everything in it and its lights, into the width and the maximum height;
  /// its upper edge is at `top_mm`.
  ArenaView(const Arena& arena, double left_mm, double top_mm, double width_mm, double height_mm);

  PagePoint at(Point point) const;
  double length(double metres) const { return metres * scale_; }
  double scale() const { return scale_; }  ///< mm on the page per metre
  double bottom() const { return bottom_; }

  std::vector<PagePoint> walls(const Arena& arena) const;
  /// An outline at a pose; circles become polygons with enough corners to look round.
  std::vector<PagePoint> outline(const Outline& outline, const Pose& pose) const;
  /// A place that is given in the frame of a body at this pose.
  PagePoint on(const Pose& pose, Point place) const;
  std::vector<PagePoint> track(const std::vector<Pose>& poses) const;

 private:
  double scale_ = 1;
  double left_ = 0;
  double top_ = 0;
  double bottom_ = 0;
  Point corner_;  ///< upper left corner of the arena's bounding box, metres
};

/// The corners of an outline in the body's own frame.
std::vector<Point> corners_of(const Outline& outline);

}  // namespace swarmsmith
