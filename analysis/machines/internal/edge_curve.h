#pragma once

#include <array>
#include <span>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Curves of transitions, and what they meet. Lengths are mm.

PagePoint operator+(PagePoint a, PagePoint b);
PagePoint operator-(PagePoint a, PagePoint b);
PagePoint operator*(double factor, PagePoint a);
double dot(PagePoint a, PagePoint b);
double length_of(PagePoint a);

/// A rectangle by its middle and half its sides.
struct PageBox {
  PagePoint centre;
  double half_width = 0;
  double half_height = 0;
};

/// How deep two boxes reach into each other, when each is `gap` wider than it is; 0 when apart.
double overlap_of(const PageBox& a, const PageBox& b, double gap);

/// From the nearest point of the box to a point; 0 within.
double distance_to(const PageBox& box, PagePoint point);

/// Begin, control and end of a quadratic Bezier curve.
using EdgeCurve = std::array<PagePoint, 3>;

PagePoint point_on(const EdgeCurve& curve, double part);

struct PageCircle {
  PagePoint centre;
  double radius = 0;
};

/// From one circle to another, through `middle`. Leaves and comes at right angles to the circles.
EdgeCurve curve_through(const PageCircle& from, const PageCircle& to, PagePoint middle);

/// The length of a segment that lies within a box.
double length_within(PagePoint from, PagePoint to, const PageBox& box);

/// From a point to the nearest one of a segment.
double distance_to_segment(PagePoint point, PagePoint from, PagePoint to);

bool segments_cross(PagePoint a, PagePoint b, PagePoint c, PagePoint d);

}  // namespace swarmsmith
