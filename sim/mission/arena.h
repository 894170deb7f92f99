#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/floor_image.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// Inner face of a wall: the segment from `from` to `to`, with the arena on its left.
struct Wall {
  Point from;
  Point to;

  friend bool operator==(const Wall&, const Wall&) = default;
};

struct Disc {
  Point centre;
  double radius_m = 0;

  friend bool operator==(const Disc&, const Disc&) = default;
};

/// A rectangle with sides parallel to the axes.
struct Rectangle {
  Point centre;
  double width_m = 0;
  double height_m = 0;

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// A picture stretched over a rectangle of the floor; for the borders of pixels see pixel_at.
struct FloorImage {
  Rectangle area;
  std::shared_ptr<const Picture> picture;  ///< never null

  /// Equal when the area and the PNG file are equal.
  friend bool operator==(const FloorImage& a, const FloorImage& b) {
    return a.area == b.area && a.picture->png() == b.picture->png();
  }
};

/// A coloured part of the floor, its border included.
struct Patch {
  std::variant<Disc, Rectangle, FloorImage> shape;
  Rgb color;  ///< not used for an image

  friend bool operator==(const Patch&, const Patch&) = default;
};

/// The patch's colour at a point, if it covers the point.
std::optional<Rgb> color_at(const Patch& patch, Point point);

/// The place where robots act: its walls and floor are data for sensors, contacts and scores.
struct Arena {
  /// Closed polygon, counter-clockwise, without crossings; it need not be convex.
  std::vector<Wall> walls;
  double wall_height_m = kWallHeight_m;
  Rgb floor{127, 127, 127};
  /// Later patches lie on top of earlier ones.
  std::vector<Patch> patches;
  std::vector<Obstacle> obstacles;
  std::vector<MovableObject> objects;
  std::vector<Light> lights;

  friend bool operator==(const Arena&, const Arena&) = default;
};

/// Colour of the floor at a point; the base colour continues outside the walls.
Rgb floor_at(const Arena& arena, Point point);

/// The arena of the thesis as its program built it: twelve walls whose tabulated centres, rounded
/// to millimetres, put the inner faces at 1.226 m on the axes and 1.22568 m elsewhere (rvr-automode
/// facts, section 7; simulator facts, section 3.1).
Arena dodecagon_of_the_thesis();

/// Walls around a polygon without flaws (sim/mission/polygon.h), given in either direction.
std::vector<Wall> walls_around(std::vector<Point> corners);

/// A regular dodecagon of the given area in square metres; the middle of a wall is on the x axis.
Arena regular_dodecagon(double area_m2);

/// The corners of the walls, counter-clockwise.
std::vector<Point> corners_of(const Arena& arena);

/// Whether the point lies within the walls.
bool is_inside(const Arena& arena, Point point);

/// Area of the polygon of walls, square metres.
double area_of(const Arena& arena);

}  // namespace swarmsmith
