#pragma once

#include <optional>

#include "sim/engine/internal/body.h"
#include "sim/engine/readings.h"

namespace swarmsmith {

/// Standard gravity as in the formula of the accelerometer, m/s^2 (thesis eq. 4.7).
inline constexpr double kGravity_mps2 = 9.81;

/// The sensors of one robot that measure its own motion (thesis 4.2.2 to 4.2.8), all without noise.
/// Q_i is the heading at the start, Q_c the present one; in a plane both are rotations about z. The
/// clock tick of the formulas is 0.1 s. Tread speeds are the set-points that acted during the cycle
/// that just ended, not the speed of the body (thesis facts, section 3).
class MotionSensors {
 public:
  explicit MotionSensors(const Body& start) : start_(start) {}

  /// m/s, axes fixed at the start pose: v = (v_l + v_r) / 2 (eq. 4.1), Q_rel = Q_i^-1 * Q_c
  /// (eq. 4.2) with angle alpha, (v cos alpha, v sin alpha, 0) (eq. 4.3).
  Vector3 velocity(const Body& now, const Command& acted) const;

  /// In units of g = 9.81 m/s^2: v_t as above (eq. 4.4 to 4.6), a = (v_t - v_(t-1)) / (G dt) (eq.
  /// 4.7); v is (0, 0) before the first call. Gravity itself is not included. Call once per cycle.
  Vector3 acceleration(const Body& now, const Command& acted);

  /// rad/s: Q_t = Q_c * Q_(t-1)^-1 (eq. 4.8), omega = its Euler angles / dt (eq. 4.9), with the yaw
  /// wrapped to (-pi, pi]; 0 at the first call. Call once per cycle.
  Vector3 spin(const Body& now);

  /// rad in (-pi, pi], in the arena's frame, which is the same for all robots (thesis 4.2.5).
  static Orientation orientation(const Body& now);

  /// Metres from the start, along the arena's axes: (X_c, Y_c) - (X_o, Y_o) (eq. 4.10).
  Point position(const Body& now) const { return {now.x - start_.x, now.y - start_.y}; }

  /// Q_rel = Q_i^-1 * Q_c (eq. 4.11), with w >= 0.
  Quaternion rotation(const Body& now) const;

 private:
  Body start_;
  Vector3 last_velocity_mps_;
  std::optional<Body> last_;
};

}  // namespace swarmsmith
