#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/control/reference_model.h"
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

/// A coloured part of the floor; borders belong to it.
struct Patch {
  std::variant<Disc, Rectangle> shape;
  Rgb color;

  friend bool operator==(const Patch&, const Patch&) = default;
};

bool contains(const Patch& patch, Point point);

/// Where robots live: walls and floor are data that sensors, contacts and scores all read.
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

/// Colour of the floor at a point; the base colour goes on outside the walls.
Rgb floor_at(const Arena& arena, Point point);

/// The thesis' arena as its program built it: twelve walls whose tabulated centres, rounded to
/// millimetres, put the inner faces at 1.226 m on the axes and 1.22568 m elsewhere
/// (rvr-automode facts, section 7; simulator facts, section 3.1).
Arena dodecagon_of_the_thesis();

/// A regular dodecagon of the given area in square metres, a wall's middle on the x axis.
Arena regular_dodecagon(double area_m2);

/// Area of the polygon of walls, square metres.
double area_of(const Arena& arena);

}  // namespace swarmsmith
