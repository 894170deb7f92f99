#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "sim/engine/internal/contacts.h"

// The rounds of the exact solver: what one contact and one drive do to the velocities. In a header,
// so that the compiler sees through the innermost loop.

namespace swarmsmith {

inline constexpr double kMaxImpulse_Ns = kMaxForce_N * kSubStep_s;
inline constexpr double kMaxTwist_Nms = kMaxTorque_Nm * kSubStep_s;
inline constexpr double kInverseMass = 1 / kMass_kg;
inline constexpr double kInverseInertia = 1 / kInertia_kg_m2;

/// A robot in the rounds. The body behind the last robot is that of all walls: nothing moves it.
struct Dynamic {
  double vx = 0;
  double vy = 0;
  double spin = 0;
  double inverse_mass = 0;
  double inverse_inertia = 0;  ///< 0 also for a robot whose spin is held
  /// What its drive gave in this sub-step.
  double drive_x_Ns = 0;
  double drive_y_Ns = 0;
  double drive_twist_Nms = 0;
  double give = 1;  ///< how much of a change of its velocity the drive answers, at most
  bool touched = false;
};

/// The other body of a contact with a wall in the rounds: what Dynamic is there, known beforehand.
struct AtRest {
  static constexpr double vx = 0;
  static constexpr double vy = 0;
  static constexpr double spin = 0;
};

/// Along one direction of a contact, from a to b.
struct Direction {
  double arm_a = 0;  ///< lever arms of an impulse
  double arm_b = 0;
  /// Speed of b against a, times the impulse that would stop it, is
  /// x (vx_b - vx_a) + y (vy_b - vy_a) + spin_b * (spin of b) - spin_a * (spin of a).
  double x = 0;
  double y = 0;
  double spin_a = 0;
  double spin_b = 0;
  /// Changes of the spins for each N s.
  double turns_a = 0;
  double turns_b = 0;

  template <class Other>
  double stopping_Ns(const Dynamic& a, const Other& b) const {
    return -((x * (b.vx - a.vx) + y * (b.vy - a.vy)) + (spin_b * b.spin - spin_a * a.spin));
  }
};

/// A contact as the rounds want it, with what it has done in this sub-step.
struct Constraint {
  std::uint64_t id = 0;
  std::size_t a = 0;
  std::size_t b = 0;
  /// Change of a's velocity for each N s along the normal; along the face it is (-y, x).
  double pushes_x = 0;
  double pushes_y = 0;
  double share_b = 0;  ///< of that change for b: 1, or 0 for a wall
  Direction normal;
  Direction face;
  double coupling = 0;   ///< change of the face's stopping impulse for each N s along the normal
  double normal_Ns = 0;  ///< impulses so far
  double friction_Ns = 0;
};

/// Filled in place: a copy would wait for what was just written.
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

/// A contact that has done nothing yet. `b` is the index of the other body, which is that of the
/// walls for a contact with one.
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

/// Impulses along the normal and along the face, from a to b.
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

/// One round for one contact; the bound of its friction is that of the normal impulse before, as in
/// Box2D. Returns the largest change. Written for short chains of operations that wait for each
/// other: they are what a round costs. `b` is AtRest of a wall, with the same bits.
template <class Other>
double relax(Constraint& c, Dynamic& a, Other& b) {
  const double normal_change = std::max(c.normal.stopping_Ns(a, b), -c.normal_Ns);
  const double bound = kFriction * c.normal_Ns;
  double stopping = c.face.stopping_Ns(a, b);
  if (c.coupling != 0) stopping -= c.coupling * normal_change;
  // Selected, not branched to: who slides and who sticks changes from one round to the next.
  const double friction_change =
      std::min(std::max(stopping, -bound - c.friction_Ns), bound - c.friction_Ns);
  c.normal_Ns += normal_change;
  c.friction_Ns += friction_change;
  push_apart(c, a, b, normal_change, friction_change);
  return std::max(std::fabs(normal_change), std::fabs(friction_change));
}

/// One round for one drive: towards the set-point, its whole impulse within the limit.
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
