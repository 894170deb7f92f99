#include "sim/engine/internal/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/engine/internal/motion.h"

namespace swarmsmith {
namespace {

/// Keeps the quotient of a gap and no motion finite, metres a sub-step.
constexpr double kLeastReach_m = 1e-9;
constexpr std::uint64_t kWallBit = std::uint64_t{1} << 63U;

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

/// Whether the point, seen from the body's centre, lies in its square.
bool holds(const Body& body, Vector point) {
  return std::fabs(point.x * body.cos + point.y * body.sin) <= kHalfSide_m &&
         std::fabs(point.y * body.cos - point.x * body.sin) <= kHalfSide_m;
}

/// The axis of the two squares along which they overlap least, from a to b.
Vector normal_between(const Body& a, const Body& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const std::array<Vector, 4> axes = {
      Vector{a.cos, a.sin}, {-a.sin, a.cos}, {b.cos, b.sin}, {-b.sin, b.cos}};
  // The squares take up as much of each axis, so the least overlap is where the centres are widest
  // apart.
  Vector normal = axes[0];
  double widest = -1;
  for (const Vector& axis : axes) {
    const double projection = dx * axis.x + dy * axis.y;
    if (std::fabs(projection) <= widest) continue;
    widest = std::fabs(projection);
    const double side = std::copysign(1.0, projection);
    normal = {side * axis.x, side * axis.y};
  }
  return normal;
}

/// Corners of `own` (0 to 3 of a, 4 to 7 of b) that lie in the other square.
void meet(Contact contact, const Body& a, const Body& b, std::vector<Contact>& found) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const bool of_a = corner < 4;
    const Body& own = of_a ? a : b;
    const Body& other = of_a ? b : a;
    const Vector from_own = corner_of(own, corner % 4);
    const Vector from_other = {own.x + from_own.x - other.x, own.y + from_own.y - other.y};
    if (!holds(other, from_other)) continue;
    const Vector& from_a = of_a ? from_own : from_other;
    const Vector& from_b = of_a ? from_other : from_own;
    found.push_back(contact);
    found.back().id |= corner;
    found.back().ax = from_a.x;
    found.back().ay = from_a.y;
    found.back().bx = from_b.x;
    found.back().by = from_b.y;
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

}  // namespace

void find_contacts(std::span<const IslandMember> island, std::span<const WallPlane> walls,
                   std::vector<Contact>& found) {
  found.clear();
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Body& a = island[i].body;
    Contact contact{.a = static_cast<int>(i)};
    for (std::size_t j = i + 1; j < island.size(); ++j) {
      const Body& b = island[j].body;
      if (gap_between(a, b) >= 0) continue;
      const Vector normal = normal_between(a, b);
      contact.b = static_cast<int>(j);
      contact.id = static_cast<std::uint64_t>(i) << 32U | static_cast<std::uint64_t>(j) << 3U;
      contact.nx = normal.x;
      contact.ny = normal.y;
      meet(contact, a, b, found);
    }
    contact.b = -1;
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (gap_to(a, walls[w]) >= 0) continue;
      contact.id =
          kWallBit | static_cast<std::uint64_t>(i) << 32U | static_cast<std::uint64_t>(w) << 3U;
      contact.nx = walls[w].nx;
      contact.ny = walls[w].ny;
      meet_wall(contact, a, walls[w], found);
    }
  }
}

int quiet_sub_steps(std::span<const IslandMember> island, std::span<const WallPlane> walls,
                    int most) {
  double quiet = most;
  for (std::size_t i = 0; i < island.size() && quiet >= 1; ++i) {
    const double reach =
        kSubStep_s * surface_speed(island[i].body, island[i].set_point) + kLeastReach_m;
    for (std::size_t j = i + 1; j < island.size(); ++j) {
      const double other = kSubStep_s * surface_speed(island[j].body, island[j].set_point);
      quiet = std::min(quiet, gap_between(island[i].body, island[j].body) / (reach + other));
    }
    for (const WallPlane& wall : walls) {
      quiet = std::min(quiet, gap_to(island[i].body, wall) / reach);
    }
  }
  return std::max(0, static_cast<int>(quiet));
}

}  // namespace swarmsmith
