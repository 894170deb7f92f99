#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Geometry of the curves for transitions. Lengths are mm.

inline PagePoint operator+(PagePoint a, PagePoint b) {
  return {a.x + b.x, a.y + b.y};
}
inline PagePoint operator-(PagePoint a, PagePoint b) {
  return {a.x - b.x, a.y - b.y};
}
inline PagePoint operator*(double factor, PagePoint a) {
  return {factor * a.x, factor * a.y};
}
inline double dot(PagePoint a, PagePoint b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(PagePoint a, PagePoint b) {
  return a.x * b.y - a.y * b.x;
}
inline double length_of(PagePoint a) {
  return std::sqrt(dot(a, a));
}

/// A rectangle, given by its centre and half of its sides.
struct PageBox {
  PagePoint centre;
  double half_width = 0;
  double half_height = 0;
};

/// How deep two boxes overlap if each is widened by `gap`; 0 if they do not.
inline double overlap_of(const PageBox& a, const PageBox& b, double gap) {
  const double x = a.half_width + b.half_width + gap - std::fabs(a.centre.x - b.centre.x);
  const double y = a.half_height + b.half_height + gap - std::fabs(a.centre.y - b.centre.y);
  return std::max(0.0, std::min(x, y));
}

/// The distance of a point from the box; 0 inside.
double distance_to(const PageBox& box, PagePoint point);

/// Start, control point and end of a quadratic Bezier curve.
using EdgeCurve = std::array<PagePoint, 3>;

PagePoint point_on(const EdgeCurve& curve, double part);

struct PageCircle {
  PagePoint centre;
  double radius = 0;
};

/// A curve from one circle to another through `middle`. It is perpendicular to both circles.
EdgeCurve curve_through(const PageCircle& from, const PageCircle& to, PagePoint middle);

/// The length of the part of a segment that lies within a box.
double length_within(PagePoint from, PagePoint to, const PageBox& box);

/// The distance of a point from a segment.
inline double distance_to_segment(PagePoint point, PagePoint from, PagePoint to) {
  const PagePoint step = to - from;
  const double length2 = dot(step, step);
  double part = 0;
  if (length2 > 0) part = std::clamp(dot(point - from, step) / length2, 0.0, 1.0);
  return length_of(point - (from + part * step));
}

inline bool segments_cross(PagePoint a, PagePoint b, PagePoint c, PagePoint d) {
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  const double side_a = cross(d - c, a - c);
  const double side_b = cross(d - c, b - c);
  return side_c * side_d < 0 && side_a * side_b < 0;
}

}  // namespace swarmsmith
