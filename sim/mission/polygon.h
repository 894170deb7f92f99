#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Polygons given by their corners in order, the last joined to the first; metres.

/// Positive when the corners are in counter-clockwise order.
double signed_area(std::span<const Point> corners);

/// Centre of mass of the area, which must not be 0.
Point centroid(std::span<const Point> corners);

/// Whether every corner turns left or is straight.
bool is_convex(std::span<const Point> corners);

/// Whether the point is inside the polygon; on its border the result may be either.
bool is_within(std::span<const Point> corners, Point point);

/// The reason why the corners are not the outline of an area, as a sentence that counts corners and
/// sides from 1: fewer than three corners, a repeated corner, sides that cross, touch or turn back,
/// no area. Nothing if the polygon is valid.
std::optional<std::string> flaw_of(std::span<const Point> corners);

/// A single side, from a list of walls.
struct Side {
  Point from;
  Point to;
};

/// The corners of sides that join end to end, each with the next and the last with the first. A gap
/// of more than a millimetre is an error that gives its place.
Expected<std::vector<Point>> corners_of(std::span<const Side> sides);

/// The line of points p with normal . p = distance; the normal has length 1 and points outwards.
struct Line {
  Point normal;
  double distance_m = 0;
};

/// The corners between consecutive lines whose normals turn counter-clockwise; the first corner is
/// between the last line and the first.
std::vector<Point> corners_between(std::span<const Line> lines);

/// Unit vector at the fraction k / n of a turn from the x axis; for multiples of 30 degrees zeros
/// and halves are exact.
Point direction_of(int k, int n);

/// The regular polygon circumscribed about the circle of radius `inradius_m` around the origin,
/// counter-clockwise, with the middle of a side on the x axis.
std::vector<Point> regular_polygon(int sides, double inradius_m);

/// Inradius of the regular polygon with this area.
double inradius_of_area(int sides, double area_m2);

/// "(1.5, -0.25)", for messages.
std::string point_text(Point point);

}  // namespace swarmsmith
