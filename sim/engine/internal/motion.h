#pragma once

#include "sim/engine/internal/body.h"

namespace swarmsmith {

/// No sound body turns by more between two checks, which are at most 0.1 s apart.
inline constexpr double kMostTurn_rad = kMostSound / 10;

/// Turns the heading by an angle, with Taylor polynomials and one step of renormalisation; the
/// error is below 1e-13 per half radian. Larger angles are turned in parts, up to `kMostTurn_rad`;
/// for angles beyond that and for NaN the heading becomes NaN.
void turn(Body& body, double angle_rad);

/// One sub-step at the present velocity and spin.
void move(Body& body);

/// The effect of force and torque in one sub-step: velocity and spin approach the set-point.
void steer(Body& body, const SetPoint& set_point, const Dynamics& dynamics = {});

/// One sub-step of free motion: move, then steer (rvr-automode facts, section 2).
void sub_step(Body& body, const SetPoint& set_point, const Dynamics& dynamics = {});

/// The same as `sub_steps` calls of sub_step, in closed form (simulator facts, section 2.1); the
/// results agree within rounding.
void advance_freely(Body& body, const SetPoint& set_point, int sub_steps,
                    const Dynamics& dynamics = {});

/// An upper bound in m/s for the speed of any point of a body in free motion from its velocity to
/// its set-point; `radius_m` is the largest distance of a point from its centre.
double surface_speed(const Body& body, const SetPoint& set_point,
                     double radius_m = kCornerRadius_m);

}  // namespace swarmsmith
