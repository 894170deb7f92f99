#pragma once

#include "sim/engine/internal/body.h"

namespace swarmsmith {

/// Turns the heading by an angle, by Taylor polynomials and one step of renormalisation; the error
/// is below 1e-13 for each half radian. Larger angles are turned in parts.
void turn(Body& body, double angle_rad);

/// The law of free motion for one sub-step: position and heading advance with the present velocity,
/// then velocity and spin move towards the set-point by what force and torque allow (rvr-automode
/// facts, section 2).
void sub_step(Body& body, const SetPoint& set_point);

/// The same as `sub_steps` calls of sub_step, in closed form (simulator facts, section 2.1), equal
/// to it within rounding.
void advance_freely(Body& body, const SetPoint& set_point, int sub_steps);

/// How fast any point of a body can be on its free way from its velocity to its set-point, m/s.
double surface_speed(const Body& body, const SetPoint& set_point);

}  // namespace swarmsmith
