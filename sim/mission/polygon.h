#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Polygons as their corners in order, the last joined to the first; metres.

/// Positive when the corners go round counter-clockwise.
double signed_area(std::span<const Point> corners);

/// Centre of mass of the area, which must not be 0.
Point centroid(std::span<const Point> corners);

/// Whether every corner turns left or not at all.
bool is_convex(std::span<const Point> corners);

/// Whether the point is inside the polygon; on its border either answer may come.
bool is_within(std::span<const Point> corners, Point point);

/// What keeps the corners from going round an area without crossing themselves, as a sentence that
/// counts corners and sides from 1: fewer than three corners, one of them twice, sides that cross,
/// touch or turn back, no area. Nothing when all is well.
std::optional<std::string> flaw_of(std::span<const Point> corners);

/// A side on its own, from a list of walls.
struct Side {
  Point from;
  Point to;
};

/// The corners of sides that join end to end, each with the next and the last with the first. A gap
/// of more than a millimetre is an error that names it.
Expected<std::vector<Point>> corners_of(std::span<const Side> sides);

/// The line of points p with normal . p = distance; the normal has length 1 and points outwards.
struct Line {
  Point normal;
  double distance_m = 0;
};

/// The corners between lines whose normals turn counter-clockwise, the first between the last line
/// and the first.
std::vector<Point> corners_between(std::span<const Line> lines);

/// Unit vector at k of n parts of the circle, counted from the x axis; multiples of 30 degrees have
/// exact zeros and halves.
Point direction_of(int k, int n);

/// Circumscribed about the circle of radius `inradius_m` around the origin, counter-clockwise, a
/// side's middle on the x axis.
std::vector<Point> regular_polygon(int sides, double inradius_m);

/// Inradius of the regular polygon with this area.
double inradius_of_area(int sides, double area_m2);

/// "(1.5, -0.25)", for sentences.
std::string point_text(Point point);

}  // namespace swarmsmith
