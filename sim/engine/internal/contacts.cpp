#include "sim/engine/internal/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "sim/engine/internal/gaps.h"
#include "sim/engine/internal/motion.h"

namespace swarmsmith {
namespace {

/// Keeps the quotient of a gap and zero motion finite, metres per sub-step.
constexpr double kLeastReach_m = 1e-9;
constexpr std::uint64_t kWallBit = std::uint64_t{1} << 63U;
constexpr std::uint64_t kObstacleBit = std::uint64_t{1} << 62U;
/// An obstacle's corners are numbered after the four corners of the square.
constexpr std::size_t kMostCorners = 60;

std::uint64_t id_of(const Meeting& meeting) {
  return static_cast<std::uint64_t>(meeting.mover) << 32U |
         static_cast<std::uint64_t>(meeting.other) << 3U;
}

struct Vector {
  double x;
  double y;
};

/// From the centre to a corner (0 to 3).
Vector corner_of(const Body& body, unsigned corner) {
  const double x = corner == 0 || corner == 3 ? kHalfSide_m : -kHalfSide_m;
  const double y = corner < 2 ? kHalfSide_m : -kHalfSide_m;
  return {body.cos * x - body.sin * y, body.sin * x + body.cos * y};
}

/// Two squares, each in the frame of the other.
struct Pair {
  Vector b_from_a;  ///< b's centre in a's frame
  Vector a_from_b;
  double cos;  ///< of b's heading relative to a's
  double sin;
};

Pair pair_of(const Body& a, const Body& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return {.b_from_a = {dx * a.cos + dy * a.sin, dy * a.cos - dx * a.sin},
          .a_from_b = {-dx * b.cos - dy * b.sin, dx * b.sin - dy * b.cos},
          .cos = a.cos * b.cos + a.sin * b.sin,
          .sin = a.cos * b.sin - a.sin * b.cos};
}

/// The same as gap_between of walls.h.
double gap_of(const Pair& pair) {
  const double widest = std::max({std::fabs(pair.b_from_a.x), std::fabs(pair.b_from_a.y),
                                  std::fabs(pair.a_from_b.x), std::fabs(pair.a_from_b.y)});
  return widest - kHalfSide_m * (1 + std::fabs(pair.cos) + std::fabs(pair.sin));
}

/// The axis along which the two squares overlap least, from a to b. Both extend equally far along
/// each axis, so it is the axis on which the centres are farthest apart.
Vector normal_of(const Pair& pair, const Body& a, const Body& b) {
  const std::array<double, 4> apart = {pair.b_from_a.x, pair.b_from_a.y, -pair.a_from_b.x,
                                       -pair.a_from_b.y};
  std::size_t widest = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (std::fabs(apart[i]) > std::fabs(apart[widest])) widest = i;
  }
  const Body& owner = widest < 2 ? a : b;
  const double side = std::copysign(1.0, apart[widest]);
  return widest % 2 == 0 ? Vector{side * owner.cos, side * owner.sin}
                         : Vector{-side * owner.sin, side * owner.cos};
}

/// The corners (bits 0 to 3) of a square that lie in another square at the origin, given its centre
/// and the cosine and sine of its heading.
unsigned corners_inside(Vector centre, double cosine, double sine) {
  const double u = kHalfSide_m * (cosine - sine);
  const double v = kHalfSide_m * (cosine + sine);
  const auto inside = [&](double x, double y) {
    return static_cast<unsigned>(std::fabs(centre.x + x) <= kHalfSide_m) &
           static_cast<unsigned>(std::fabs(centre.y + y) <= kHalfSide_m);
  };
  return inside(u, v) | inside(-v, u) << 1U | inside(-u, -v) << 2U | inside(v, -u) << 3U;
}

/// Adds the corners (0 to 3 of a, 4 to 7 of b) that lie in the other square.
void meet(Contact contact, const Pair& pair, const Body& a, const Body& b,
          std::vector<Contact>& found) {
  const unsigned corners = corners_inside(pair.a_from_b, pair.cos, -pair.sin) |
                           corners_inside(pair.b_from_a, pair.cos, pair.sin) << 4U;
  for (unsigned corner = 0; corner < 8; ++corner) {
    if ((corners >> corner & 1U) == 0) continue;
    const bool of_a = corner < 4;
    const Vector from_own = corner_of(of_a ? a : b, corner % 4);
    const double x = (of_a ? a.x : b.x) + from_own.x;
    const double y = (of_a ? a.y : b.y) + from_own.y;
    found.push_back(contact);
    found.back().id |= corner;
    found.back().ax = x - a.x;
    found.back().ay = y - a.y;
    found.back().bx = x - b.x;
    found.back().by = y - b.y;
  }
}

void meet_wall(Contact contact, const Body& body, const WallPlane& wall,
               std::vector<Contact>& found) {
  for (unsigned corner = 0; corner < 4; ++corner) {
    const Vector at = corner_of(body, corner);
    if (wall.depth_of(body.x + at.x, body.y + at.y) > 0) continue;
    found.push_back(contact);
    found.back().id |= corner;
    found.back().ax = at.x;
    found.back().ay = at.y;
  }
}

/// An axis between a square and a solid, and the gap along it: negative when they overlap.
struct Axis {
  double gap = -std::numeric_limits<double>::infinity();
  double nx = 0;  ///< unit vector from the square to the solid
  double ny = 0;

  void widen(double other, double x, double y) {
    if (other <= gap) return;
    gap = other;
    nx = x;
    ny = y;
  }
};

/// The axis with the least overlap among the normals of all sides.
Axis axis_between(const Body& body, const FixedSolid& solid) {
  const Body& at = solid.at;
  const double dx = at.x - body.x;
  const double dy = at.y - body.y;
  Axis axis;
  for (const double side : {1.0, -1.0}) {
    for (const Vector normal :
         {Vector{side * body.cos, side * body.sin}, Vector{-side * body.sin, side * body.cos}}) {
      const double apart = normal.x * dx + normal.y * dy;
      axis.widen(apart - kHalfSide_m - extent_along(solid.form, at, -normal.x, -normal.y), normal.x,
                 normal.y);
    }
  }
  for (std::size_t i = 0; i < solid.form.normals.size(); ++i) {
    const Point& normal = solid.form.normals[i];
    const double x = normal.x * at.cos - normal.y * at.sin;
    const double y = normal.x * at.sin + normal.y * at.cos;
    const double own = normal.x * solid.form.corners[i].x + normal.y * solid.form.corners[i].y;
    const double reach = kHalfSide_m * (std::fabs(x * body.cos + y * body.sin) +
                                        std::fabs(y * body.cos - x * body.sin));
    axis.widen(-(x * dx + y * dy) - own - reach, -x, -y);
  }
  return axis;
}

bool is_inside(const FixedSolid& solid, double x, double y) {
  const Body& at = solid.at;
  const double own_x = (x - at.x) * at.cos + (y - at.y) * at.sin;
  const double own_y = (y - at.y) * at.cos - (x - at.x) * at.sin;
  for (std::size_t i = 0; i < solid.form.normals.size(); ++i) {
    const Point& normal = solid.form.normals[i];
    const Point& corner = solid.form.corners[i];
    if (normal.x * (own_x - corner.x) + normal.y * (own_y - corner.y) > 0) return false;
  }
  return true;
}

/// Adds the corners of the square that lie in the solid, then the corners of the solid that lie in
/// the square.
void meet_polygon(Contact contact, const Body& body, const FixedSolid& solid,
                  std::vector<Contact>& found) {
  const Axis axis = axis_between(body, solid);
  if (axis.gap >= 0) return;
  contact.nx = axis.nx;
  contact.ny = axis.ny;
  const auto add = [&](std::size_t corner, double x, double y) {
    found.push_back(contact);
    found.back().id |= corner;
    found.back().ax = x;
    found.back().ay = y;
  };
  for (unsigned corner = 0; corner < 4; ++corner) {
    const Vector from_own = corner_of(body, corner);
    if (is_inside(solid, body.x + from_own.x, body.y + from_own.y))
      add(corner, from_own.x, from_own.y);
  }
  SWARMSMITH_ASSERT(solid.form.corners.size() <= kMostCorners, "an obstacle has few corners");
  for (std::size_t i = 0; i < solid.form.corners.size(); ++i) {
    const Point& corner = solid.form.corners[i];
    const double x = solid.at.x + solid.at.cos * corner.x - solid.at.sin * corner.y - body.x;
    const double y = solid.at.y + solid.at.sin * corner.x + solid.at.cos * corner.y - body.y;
    if (std::fabs(x * body.cos + y * body.sin) > kHalfSide_m ||
        std::fabs(y * body.cos - x * body.sin) > kHalfSide_m)
      continue;
    add(4 + i, x, y);
  }
}

/// Adds the point of the square that is nearest to the circle's centre; a centre inside the square
/// is pushed out through its nearest side.
void meet_circle(Contact contact, const Body& body, const FixedSolid& solid,
                 std::vector<Contact>& found) {
  const double dx = solid.at.x - body.x;
  const double dy = solid.at.y - body.y;
  const Vector centre = {dx * body.cos + dy * body.sin, dy * body.cos - dx * body.sin};
  const Vector nearest = {std::clamp(centre.x, -kHalfSide_m, kHalfSide_m),
                          std::clamp(centre.y, -kHalfSide_m, kHalfSide_m)};
  Vector normal = {centre.x - nearest.x, centre.y - nearest.y};
  const double distance = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  if (distance >= solid.form.radius_m) return;
  if (distance > 0) {
    normal = {normal.x / distance, normal.y / distance};
  } else if (std::fabs(centre.x) > std::fabs(centre.y)) {
    normal = {std::copysign(1.0, centre.x), 0};
  } else {
    normal = {0, std::copysign(1.0, centre.y)};
  }
  found.push_back(contact);
  found.back().nx = normal.x * body.cos - normal.y * body.sin;
  found.back().ny = normal.x * body.sin + normal.y * body.cos;
  found.back().ax = nearest.x * body.cos - nearest.y * body.sin;
  found.back().ay = nearest.x * body.sin + nearest.y * body.cos;
}

}  // namespace

void find_contacts(std::span<const Mover> movers, const Island& island,
                   const Surroundings& surroundings, std::vector<Contact>& found) {
  found.clear();
  for (const Meeting& meeting : island.pairs) {
    const Body& a = movers[static_cast<std::size_t>(meeting.mover)].body;
    const Body& b = movers[static_cast<std::size_t>(meeting.other)].body;
    const Pair pair = pair_of(a, b);
    if (gap_of(pair) >= 0) continue;
    const Vector normal = normal_of(pair, a, b);
    meet({.a = meeting.mover,
          .b = meeting.other,
          .id = id_of(meeting),
          .nx = normal.x,
          .ny = normal.y},
         pair, a, b, found);
  }
  for (const Meeting& meeting : island.obstacles) {
    const Body& a = movers[static_cast<std::size_t>(meeting.mover)].body;
    const auto other = static_cast<std::size_t>(meeting.other);
    const FixedSolid& solid = surroundings.obstacles[other];
    const Contact contact{.a = meeting.mover,
                          .b = -1,
                          .id = kObstacleBit | static_cast<std::uint64_t>(meeting.mover) << 32U |
                                static_cast<std::uint64_t>(other) << 6U};
    if (solid.form.is_circle()) {
      meet_circle(contact, a, solid, found);
    } else {
      meet_polygon(contact, a, solid, found);
    }
  }
  for (const Meeting& meeting : island.walls) {
    const Body& a = movers[static_cast<std::size_t>(meeting.mover)].body;
    const WallPlane& wall = surroundings.walls.planes[static_cast<std::size_t>(meeting.other)];
    if (gap_to(a, wall) >= 0) continue;
    meet_wall({.a = meeting.mover,
               .b = -1,
               .id = kWallBit | id_of(meeting),
               .nx = wall.nx,
               .ny = wall.ny},
              a, wall, found);
  }
}

int quiet_sub_steps(std::span<const Mover> movers, const Island& island,
                    const Surroundings& surroundings, int most) {
  double quiet = most;
  const auto reach_of = [](const Mover& mover) {
    return kSubStep_s * surface_speed(mover.body, mover.set_point, mover.form().radius_m);
  };
  for (const Meeting& meeting : island.pairs) {
    const Mover& a = movers[static_cast<std::size_t>(meeting.mover)];
    const Mover& b = movers[static_cast<std::size_t>(meeting.other)];
    const double gap = gap_between(a.form(), a.body, b.form(), b.body);
    if (gap < 0) return 0;
    quiet = std::min(quiet, gap / (reach_of(a) + reach_of(b) + kLeastReach_m));
  }
  for (const Meeting& meeting : island.walls) {
    const Mover& a = movers[static_cast<std::size_t>(meeting.mover)];
    const WallPlane& wall = surroundings.walls.planes[static_cast<std::size_t>(meeting.other)];
    const double gap = a.form().is_rvr && surroundings.walls.convex
                           ? gap_to(a.body, wall)
                           : gap_to(a.form(), a.body, wall);
    if (gap < 0) return 0;
    quiet = std::min(quiet, gap / (reach_of(a) + kLeastReach_m));
  }
  for (const Meeting& meeting : island.obstacles) {
    const Mover& a = movers[static_cast<std::size_t>(meeting.mover)];
    const FixedSolid& solid = surroundings.obstacles[static_cast<std::size_t>(meeting.other)];
    const double gap = gap_between(a.form(), a.body, solid.form, solid.at);
    if (gap < 0) return 0;
    quiet = std::min(quiet, gap / (reach_of(a) + kLeastReach_m));
  }
  return static_cast<int>(quiet);
}

}  // namespace swarmsmith
