#include "analysis/arena/internal/arena_view.h"

#include <algorithm>
#include <limits>

#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

/// The bounding box of points.
struct Box {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(Point point) {
    left = std::min(left, point.x);
    right = std::max(right, point.x);
    low = std::min(low, point.y);
    high = std::max(high, point.y);
  }
};

Point moved(const Pose& pose, Point place) {
  const SinCos turn = sin_cos(pose.theta);
  return {pose.x + turn.cos * place.x - turn.sin * place.y,
          pose.y + turn.sin * place.x + turn.cos * place.y};
}

}  // namespace

std::vector<Point> corners_of(const Outline& outline) {
  return std::visit(
      Overloaded{[](const CircleOutline& circle) {
                   constexpr int kCorners = 48;
                   std::vector<Point> corners;
                   for (int i = 0; i < kCorners; ++i) {
                     const SinCos turn = sin_cos(2 * kPi * i / kCorners);
                     corners.push_back({circle.radius_m * turn.cos, circle.radius_m * turn.sin});
                   }
                   return corners;
                 },
                 [](const BoxOutline& box) {
                   const double x = 0.5 * box.length_m;
                   const double y = 0.5 * box.width_m;
                   return std::vector<Point>{{x, y}, {-x, y}, {-x, -y}, {x, -y}};
                 },
                 [](const PolygonOutline& polygon) { return polygon.corners; }},
      outline);
}

ArenaView::ArenaView(const Arena& arena, double left_mm, double top_mm, double width_mm,
                     double height_mm) {
  Box box;
  for (const Wall& wall : arena.walls)
    box.add(wall.from);
  for (const Light& light : arena.lights)
    box.add({light.x_m, light.y_m});
  // Leaves room for the walls' thickness, and for the signs of lights.
  const double inset = arena.lights.empty() ? 0.5 : 2.2;
  const double width = width_mm - 2 * inset;
  const double height = height_mm - 2 * inset;
  scale_ = std::min(width / (box.right - box.left), height / (box.high - box.low));
  left_ = left_mm + inset + 0.5 * (width - scale_ * (box.right - box.left));
  top_ = top_mm + inset;
  bottom_ = top_ + scale_ * (box.high - box.low) + inset;
  corner_ = {box.left, box.high};
}

PagePoint ArenaView::at(Point point) const {
  return {left_ + scale_ * (point.x - corner_.x), top_ + scale_ * (corner_.y - point.y)};
}

PagePoint ArenaView::on(const Pose& pose, Point place) const {
  return at(moved(pose, place));
}

std::vector<PagePoint> ArenaView::walls(const Arena& arena) const {
  std::vector<PagePoint> corners;
  for (const Wall& wall : arena.walls)
    corners.push_back(at(wall.from));
  return corners;
}

std::vector<PagePoint> ArenaView::outline(const Outline& outline, const Pose& pose) const {
  std::vector<PagePoint> corners;
  for (const Point corner : corners_of(outline))
    corners.push_back(on(pose, corner));
  return corners;
}

std::vector<PagePoint> ArenaView::track(const std::vector<Pose>& poses) const {
  std::vector<PagePoint> points;
  points.reserve(poses.size());
  for (const Pose& pose : poses)
    points.push_back(at(pose.position()));
  return points;
}

}  // namespace swarmsmith
