#pragma once

#include "sim/engine/internal/body.h"

namespace swarmsmith {

/// No sound body turns farther between two looks at it, which are at most 0.1 s apart.
inline constexpr double kMostTurn_rad = kMostSound / 10;

/// Turns the heading by an angle, by Taylor polynomials and one step of renormalisation; the error
/// is below 1e-13 for each half radian. Larger angles are turned in parts, up to `kMostTurn_rad`;
/// beyond, and for what is not a number, the heading becomes not a number.
void turn(Body& body, double angle_rad);

/// One sub-step at the present velocity and spin.
void move(Body& body);

/// What force and torque do in one sub-step: velocity and spin come nearer to the set-point.
void steer(Body& body, const SetPoint& set_point, const Dynamics& dynamics = {});

/// The law of free motion for one sub-step: move, then steer (rvr-automode facts, section 2).
void sub_step(Body& body, const SetPoint& set_point, const Dynamics& dynamics = {});

/// The same as `sub_steps` calls of sub_step, in closed form (simulator facts, section 2.1), equal
/// to it within rounding.
void advance_freely(Body& body, const SetPoint& set_point, int sub_steps,
                    const Dynamics& dynamics = {});

/// How fast any point of a body can be on its free way from its velocity to its set-point, m/s;
/// none is farther than `radius_m` from its centre.
double surface_speed(const Body& body, const SetPoint& set_point,
                     double radius_m = kCornerRadius_m);

}  // namespace swarmsmith
