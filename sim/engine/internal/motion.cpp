#include "sim/engine/internal/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace swarmsmith {
namespace {

void rotate(Body& body, double cosine, double sine) {
  const double c = body.cos * cosine - body.sin * sine;
  const double s = body.cos * sine + body.sin * cosine;
  // One step of Newton's method for 1 / sqrt(c^2 + s^2), which is 1 within rounding.
  const double scale = 1.5 - 0.5 * (c * c + s * s);
  body.cos = c * scale;
  body.sin = s * scale;
}

/// For |angle| up to 1/16, enough for a sub-step: sine to x^7, cosine to x^8; the omitted terms are
/// below 4e-17.
void turn_slightly(Body& body, double angle_rad) {
  const double s = angle_rad * angle_rad;
  const double sine = angle_rad * (1 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040))));
  const double cosine = 1 + s * (-1.0 / 2 + s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320))));
  rotate(body, cosine, sine);
}

/// For |angle| up to 0.5: sine to x^11, cosine to x^12; the omitted terms are below 3e-14.
void turn_part(Body& body, double angle_rad) {
  const double s = angle_rad * angle_rad;
  const double sine =
      angle_rad *
      (1 + s * (-1.0 / 6 +
                s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800))))));
  const double cosine =
      1 +
      s * (-1.0 / 2 +
           s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320 +
                                                  s * (-1.0 / 3628800 + s * (1.0 / 479001600.))))));
  rotate(body, cosine, sine);
}

/// A quantity that starts `distance` away from its target and approaches it by `step` in each
/// sub-step.
struct Approach {
  double sum;   ///< sum of its distances before each of the sub-steps
  double left;  ///< its distance after them
};

Approach approach(double distance, double step, int sub_steps) {
  const double ratio = distance / step;
  const double off = ratio >= sub_steps ? sub_steps : static_cast<int>(ratio) + 1;
  return {.sum = off * distance - step * (off * (off - 1) / 2),
          .left = std::max(0.0, distance - sub_steps * step)};
}

}  // namespace

Body body_at(const Pose& pose) {
  const SinCos heading = sin_cos(pose.theta);
  return {.x = pose.x, .y = pose.y, .cos = heading.cos, .sin = heading.sin};
}

Pose pose_of(const Body& body) {
  return {body.x, body.y, atan2(body.sin, body.cos)};
}

void turn(Body& body, double angle_rad) {
  const double size = std::fabs(angle_rad);
  if (size <= 0.0625) return turn_slightly(body, angle_rad);
  if (size <= 0.5) return turn_part(body, angle_rad);
  if (!(size <= kMostTurn_rad)) [[unlikely]] {
    body.cos = body.sin = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const int parts = static_cast<int>(size * 2) + 1;
  for (int i = 0; i < parts; ++i)
    turn_part(body, angle_rad / parts);
}

void move(Body& body) {
  body.x += kSubStep_s * body.vx;
  body.y += kSubStep_s * body.vy;
  turn(body, kSubStep_s * body.spin);
}

void steer(Body& body, const SetPoint& set_point, const Dynamics& dynamics) {
  const double dx = set_point.vx - body.vx;
  const double dy = set_point.vy - body.vy;
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance <= dynamics.speed_step_mps) {
    body.vx = set_point.vx;
    body.vy = set_point.vy;
  } else {
    body.vx += dx / distance * dynamics.speed_step_mps;
    body.vy += dy / distance * dynamics.speed_step_mps;
  }
  body.spin +=
      std::clamp(set_point.spin - body.spin, -dynamics.spin_step_radps, dynamics.spin_step_radps);
}

void sub_step(Body& body, const SetPoint& set_point, const Dynamics& dynamics) {
  move(body);
  steer(body, set_point, dynamics);
}

void advance_freely(Body& body, const SetPoint& set_point, int sub_steps,
                    const Dynamics& dynamics) {
  const double span_s = sub_steps * kSubStep_s;
  const double dx = set_point.vx - body.vx;
  const double dy = set_point.vy - body.vy;
  body.x += span_s * set_point.vx;
  body.y += span_s * set_point.vy;
  if (dx != 0 || dy != 0) {
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (distance == 0) {
      // Below 1e-162 m/s the square is 0, and the quotients below would be NaN. Robots that pressed
      // and then stop reach such speeds: in contact, the rest of their speed shrinks by a factor in
      // each sub-step, until Reach treats them as standing and they are free.
      body.vx = set_point.vx;
      body.vy = set_point.vy;
    } else {
      const Approach speed = approach(distance, dynamics.speed_step_mps, sub_steps);
      const double lag = kSubStep_s * speed.sum / distance;
      const double left = speed.left / distance;
      body.x -= lag * dx;
      body.y -= lag * dy;
      body.vx = set_point.vx - left * dx;
      body.vy = set_point.vy - left * dy;
    }
  }
  const double dw = set_point.spin - body.spin;
  double angle = span_s * set_point.spin;
  if (dw != 0) {
    const Approach spin = approach(std::fabs(dw), dynamics.spin_step_radps, sub_steps);
    angle -= kSubStep_s * std::copysign(spin.sum, dw);
    body.spin = set_point.spin - std::copysign(spin.left, dw);
  }
  if (angle != 0) turn(body, angle);
}

double surface_speed(const Body& body, const SetPoint& set_point, double radius_m) {
  const double speed2 = std::max(body.vx * body.vx + body.vy * body.vy,
                                 set_point.vx * set_point.vx + set_point.vy * set_point.vy);
  return std::sqrt(speed2) + radius_m * std::max(std::fabs(body.spin), std::fabs(set_point.spin));
}

}  // namespace swarmsmith
