#include "sim/engine/internal/motion_sensors.h"

#include "base/math.h"

namespace swarmsmith {
namespace {

/// The rotation about z from one heading to another.
SinCos turn_between(const Body& from, const Body& to) {
  return {.sin = from.cos * to.sin - from.sin * to.cos,
          .cos = from.cos * to.cos + from.sin * to.sin};
}

}  // namespace

Vector3 MotionSensors::velocity(const Body& now, const Command& acted) const {
  const double speed = (acted.left_mps + acted.right_mps) / 2;
  const SinCos alpha = turn_between(start_, now);
  return {.x = speed * alpha.cos, .y = speed * alpha.sin, .z = 0};
}

Vector3 MotionSensors::acceleration(const Body& now, const Command& acted) {
  const Vector3 before = last_velocity_mps_;
  last_velocity_mps_ = velocity(now, acted);
  constexpr double kScale = kGravity_mps2 * kControlPeriod_s;
  return {.x = (last_velocity_mps_.x - before.x) / kScale,
          .y = (last_velocity_mps_.y - before.y) / kScale,
          .z = 0};
}

Vector3 MotionSensors::spin(const Body& now) {
  double yaw = 0;
  if (last_) {
    const SinCos turned = turn_between(*last_, now);
    yaw = atan2(turned.sin, turned.cos);
  }
  last_ = now;
  return {.x = 0, .y = 0, .z = yaw / kControlPeriod_s};
}

Orientation MotionSensors::orientation(const Body& now) {
  return {.pitch_rad = 0, .roll_rad = 0, .yaw_rad = atan2(now.sin, now.cos)};
}

Quaternion MotionSensors::rotation(const Body& now) const {
  const SinCos alpha = turn_between(start_, now);
  const SinCos half = sin_cos(atan2(alpha.sin, alpha.cos) / 2);
  return {.w = half.cos, .x = 0, .y = 0, .z = half.sin};
}

}  // namespace swarmsmith
