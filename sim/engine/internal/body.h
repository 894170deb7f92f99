#pragma once

#include "sim/control/reference_model.h"
#include "sim/control/treads.h"
#include "sim/engine/internal/two.h"
#include "sim/mission/mission.h"
#include "sim/mission/pose.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {

/// Bodies and the RVR's drive (rvr-automode facts, section 2). SI units; world frame.

inline constexpr double kHalfSide_m = kBodySide_m / 2;
/// From the centre to a corner of the square.
inline constexpr double kCornerRadius_m = kHalfSide_m * 1.4142135623730951;
inline constexpr double kInertia_kg_m2 = kMass_kg * 2 * kBodySide_m * kBodySide_m / 12;

/// The resolution of simulated time: clocks count sub-steps, and contacts are solved at each.
inline constexpr double kSubStep_s = 0.01;
/// Scores and recorders observe the world every 0.1 s.
inline constexpr int kSubStepsPerInstant = 10;
/// The largest change that the drive can make in one sub-step to the velocity vector and to the
/// spin.
inline constexpr double kSpeedStep_mps = kMaxForce_N / kMass_kg * kSubStep_s;
inline constexpr double kSpinStep_radps = kMaxTorque_Nm / kInertia_kg_m2 * kSubStep_s;

/// State of one robot or object. The heading is stored as the unit vector (cos, sin), not as an
/// angle, so that motion needs no trigonometric functions.
struct Body {
  double x = 0;
  double y = 0;
  double cos = 1;
  double sin = 0;
  double vx = 0;
  double vy = 0;
  double spin = 0;  ///< rad/s, counter-clockwise

  friend bool operator==(const Body&, const Body&) = default;
};

/// The velocity and spin that the drive aims at; the velocity is a vector in the world frame,
/// constant while the heading turns.
struct SetPoint {
  double vx = 0;
  double vy = 0;
  double spin = 0;

  friend bool operator==(const SetPoint&, const SetPoint&) = default;
};

/// How a body responds to force, and how strongly it is driven; by default the RVR's values. An
/// object is driven towards rest, by the friction of the floor.
struct Dynamics {
  double mass_kg = kMass_kg;
  double inertia_kg_m2 = kInertia_kg_m2;
  double max_force_N = kMaxForce_N;
  double max_torque_Nm = kMaxTorque_Nm;
  /// The changes that the maximum force and torque make in one sub-step.
  double speed_step_mps = kSpeedStep_mps;
  double spin_step_radps = kSpinStep_radps;

  friend bool operator==(const Dynamics&, const Dynamics&) = default;
};

/// A limit in SI units far above any pose, velocity or spin of a realistic world.
inline constexpr double kMostSound = 1e6;

/// Whether all numbers of the body are finite and within `kMostSound`.
inline bool is_sound(const Body& body) {
  // Written so that NaN is not sound.
  const auto within = [](Two pair) { return (pair <= kMostSound) & (pair >= -kMostSound); };
  const auto sound = within(Two{body.x, body.y}) & within(Two{body.cos, body.sin}) &
                     within(Two{body.vx, body.vy}) & within(both(body.spin));
  return (sound[0] & sound[1]) != 0;
}

/// A body at rest at the pose.
Body body_at(const Pose& pose);
Pose pose_of(const Body& body);

/// Set-point of a command that begins to act at the body's present heading; `track_m` is the
/// distance between the wheels.
inline SetPoint set_point_of(const Command& command, const Body& body,
                             double track_m = kTreadDistance_m) {
  const double speed = (command.left_mps + command.right_mps) / 2;
  return {.vx = speed * body.cos,
          .vy = speed * body.sin,
          .spin = (command.right_mps - command.left_mps) / track_m};
}

}  // namespace swarmsmith
