#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "sim/engine/internal/contacts.h"

// The iterations of the exact solver: the effect of one contact and of one drive on the velocities.
// They are in a header so that the compiler can optimise the innermost loop.

namespace swarmsmith {

inline constexpr double kMaxImpulse_Ns = kMaxForce_N * kSubStep_s;
inline constexpr double kMaxTwist_Nms = kMaxTorque_Nm * kSubStep_s;
inline constexpr double kInverseMass = 1 / kMass_kg;
inline constexpr double kInverseInertia = 1 / kInertia_kg_m2;

/// A robot during the iterations. The entry after the last robot represents all walls; it never
/// moves.
struct Dynamic {
  double vx = 0;
  double vy = 0;
  double spin = 0;
  double inverse_mass = 0;
  double inverse_inertia = 0;  ///< also 0 for a robot whose spin is held
  /// The impulse of its drive in this sub-step.
  double drive_x_Ns = 0;
  double drive_y_Ns = 0;
  double drive_twist_Nms = 0;
  double give = 1;  ///< largest fraction of a change of its velocity that the drive counteracts
  bool touched = false;
};

/// The other body of a contact with a wall: it has the values of a Dynamic at rest, known at
/// compile time.
struct AtRest {
  static constexpr double vx = 0;
  static constexpr double vy = 0;
  static constexpr double spin = 0;
};

/// The terms of a contact along one direction, from a to b.
struct Direction {
  double arm_a = 0;  ///< lever arms of an impulse
  double arm_b = 0;
  /// The impulse that stops the relative motion of a and b along this direction is -(x (vx_b -
  /// vx_a) + y (vy_b - vy_a) + spin_b * (spin of b) - spin_a * (spin of a)).
  double x = 0;
  double y = 0;
  double spin_a = 0;
  double spin_b = 0;
  /// Changes of the spins per N s.
  double turns_a = 0;
  double turns_b = 0;

  template <class Other>
  double stopping_Ns(const Dynamic& a, const Other& b) const {
    return -((x * (b.vx - a.vx) + y * (b.vy - a.vy)) + (spin_b * b.spin - spin_a * a.spin));
  }
};

/// A contact as the iterations need it, with its impulses in this sub-step.
struct Constraint {
  std::uint64_t id = 0;
  std::size_t a = 0;
  std::size_t b = 0;
  /// Change of a's velocity per N s along the normal; along the face it is (-y, x).
  double pushes_x = 0;
  double pushes_y = 0;
  double share_b = 0;  ///< fraction of that change that applies to b: 1, or 0 for a wall
  Direction normal;
  Direction face;
  double coupling = 0;   ///< change of the face's stopping impulse per N s along the normal
  double normal_Ns = 0;  ///< impulses so far
  double friction_Ns = 0;
};

/// Filled in place: a copy would wait for the values that were just written.
inline void set_direction(Direction& d, const Contact& contact, double x, double y,
                          const Dynamic& a, const Dynamic& b) {
  d.arm_a = contact.ax * y - contact.ay * x;
  d.arm_b = contact.bx * y - contact.by * x;
  const double mass = 1 / (a.inverse_mass + b.inverse_mass + d.arm_a * d.arm_a * a.inverse_inertia +
                           d.arm_b * d.arm_b * b.inverse_inertia);
  d.x = mass * x;
  d.y = mass * y;
  d.spin_a = mass * d.arm_a;
  d.spin_b = mass * d.arm_b;
  d.turns_a = d.arm_a * a.inverse_inertia;
  d.turns_b = d.arm_b * b.inverse_inertia;
}

/// Initialises a contact without impulses. `b` is the index of the other body; for a contact with a
/// wall it is the entry of all walls.
inline void set_constraint(Constraint& c, const Contact& contact, std::size_t b,
                           const Dynamic& first, const Dynamic& other) {
  c.id = contact.id;
  c.a = static_cast<std::size_t>(contact.a);
  c.b = b;
  c.pushes_x = contact.nx * kInverseMass;
  c.pushes_y = contact.ny * kInverseMass;
  c.share_b = contact.b < 0 ? 0 : 1;
  set_direction(c.normal, contact, contact.nx, contact.ny, first, other);
  set_direction(c.face, contact, -contact.ny, contact.nx, first, other);
  c.coupling = c.face.spin_a * c.normal.turns_a + c.face.spin_b * c.normal.turns_b;
  c.normal_Ns = 0;
  c.friction_Ns = 0;
}

/// Applies impulses along the normal and along the face, from a to b.
template <class Other>
void push_apart(const Constraint& c, Dynamic& a, Other& b, double normal_Ns, double friction_Ns) {
  const double x = c.pushes_x * normal_Ns - c.pushes_y * friction_Ns;
  const double y = c.pushes_y * normal_Ns + c.pushes_x * friction_Ns;
  a.vx -= x;
  a.vy -= y;
  a.spin -= c.normal.turns_a * normal_Ns + c.face.turns_a * friction_Ns;
  if constexpr (std::is_same_v<Other, Dynamic>) {
    b.vx += c.share_b * x;
    b.vy += c.share_b * y;
    b.spin += c.normal.turns_b * normal_Ns + c.face.turns_b * friction_Ns;
  }
}

/// One iteration for one contact; friction is bounded by the normal impulse before this iteration,
/// as in Box2D. Returns the largest change. Written for short chains of dependent operations,
/// because these determine the cost of an iteration. For a wall `b` is AtRest, which gives the same
/// bits.
template <class Other>
double relax(Constraint& c, Dynamic& a, Other& b) {
  const double normal_change = std::max(c.normal.stopping_Ns(a, b), -c.normal_Ns);
  const double bound = kFriction * c.normal_Ns;
  double stopping = c.face.stopping_Ns(a, b);
  if (c.coupling != 0) stopping -= c.coupling * normal_change;
  // Selected without a branch: whether a contact slides or sticks changes from one iteration to the
  // next.
  const double friction_change =
      std::min(std::max(stopping, -bound - c.friction_Ns), bound - c.friction_Ns);
  c.normal_Ns += normal_change;
  c.friction_Ns += friction_change;
  push_apart(c, a, b, normal_change, friction_change);
  return std::max(std::fabs(normal_change), std::fabs(friction_change));
}

/// One iteration for one drive: towards the set-point, with its whole impulse within the limit.
inline void relax_drive(const SetPoint& set_point, Dynamic& robot) {
  double x = robot.drive_x_Ns + kMass_kg * (set_point.vx - robot.vx);
  double y = robot.drive_y_Ns + kMass_kg * (set_point.vy - robot.vy);
  const double size2 = x * x + y * y;
  if (robot.inverse_inertia != 0) {
    const double twist =
        std::clamp(robot.drive_twist_Nms + kInertia_kg_m2 * (set_point.spin - robot.spin),
                   -kMaxTwist_Nms, kMaxTwist_Nms);
    robot.spin += (twist - robot.drive_twist_Nms) * kInverseInertia;
    robot.drive_twist_Nms = twist;
  }
  robot.give = 1;
  if (size2 > kMaxImpulse_Ns * kMaxImpulse_Ns) {
    const double scale = kMaxImpulse_Ns / std::sqrt(size2);
    if (robot.inverse_inertia == 0) robot.give = scale;
    x *= scale;
    y *= scale;
  }
  robot.vx += (x - robot.drive_x_Ns) * kInverseMass;
  robot.vy += (y - robot.drive_y_Ns) * kInverseMass;
  robot.drive_x_Ns = x;
  robot.drive_y_Ns = y;
}

}  // namespace swarmsmith
