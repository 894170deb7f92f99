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

/// The grain of simulated time: clocks count these, contacts are solved at these.
inline constexpr double kSubStep_s = 0.01;
/// Scores and recorders look at the world every 0.1 s.
inline constexpr int kSubStepsPerInstant = 10;
/// What the drive can change in one sub-step: speed as a vector, and spin.
inline constexpr double kSpeedStep_mps = kMaxForce_N / kMass_kg * kSubStep_s;
inline constexpr double kSpinStep_radps = kMaxTorque_Nm / kInertia_kg_m2 * kSubStep_s;

/// State of one robot or object. The heading is kept as the unit vector (cos, sin): no angle is
/// stored, so that no trigonometric function is needed while a body moves.
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

/// What the drive steers towards; a world-frame vector, held while the heading turns.
struct SetPoint {
  double vx = 0;
  double vy = 0;
  double spin = 0;

  friend bool operator==(const SetPoint&, const SetPoint&) = default;
};

/// How a body answers to force, and how strongly it is steered: the RVR's, unless said. An object
/// steers towards rest, by the friction of the floor.
struct Dynamics {
  double mass_kg = kMass_kg;
  double inertia_kg_m2 = kInertia_kg_m2;
  double max_force_N = kMaxForce_N;
  double max_torque_Nm = kMaxTorque_Nm;
  /// What those change in one sub-step.
  double speed_step_mps = kSpeedStep_mps;
  double spin_step_radps = kSpinStep_radps;

  friend bool operator==(const Dynamics&, const Dynamics&) = default;
};

/// What no pose, velocity or spin of a world that makes sense comes near to, in SI units.
inline constexpr double kMostSound = 1e6;

/// Whether all of its numbers are finite, and within `kMostSound`.
inline bool is_sound(const Body& body) {
  // Written so that what is not a number is not sound.
  const auto within = [](Two pair) { return (pair <= kMostSound) & (pair >= -kMostSound); };
  const auto sound = within(Two{body.x, body.y}) & within(Two{body.cos, body.sin}) &
                     within(Two{body.vx, body.vy}) & within(both(body.spin));
  return (sound[0] & sound[1]) != 0;
}

/// A body that stands at the pose.
Body body_at(const Pose& pose);
Pose pose_of(const Body& body);

/// Set-point of a command that starts to act at the body's present heading, of wheels so far apart.
inline SetPoint set_point_of(const Command& command, const Body& body,
                             double track_m = kTreadDistance_m) {
  const double speed = (command.left_mps + command.right_mps) / 2;
  return {.vx = speed * body.cos,
          .vy = speed * body.sin,
          .spin = (command.right_mps - command.left_mps) / track_m};
}

}  // namespace swarmsmith
