#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/network.h"
#include "sim/engine/profile.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// The reason, as a sentence, why modules of the flavour cannot run on the robot; nothing when they
/// can. They must take distances or strengths, whichever the robot's sensors give, and the
/// flavour's reference model must be one that this robot can be simulated with.
std::optional<std::string> misfit(const Flavour& flavour, const Robot& robot);

/// The reason, as a sentence, why the profile cannot be used for the robot; nothing when it can:
/// fields that have no effect on the robot must be as in an ideal profile.
std::optional<std::string> misfit(const Profile& profile, const Robot& robot);

/// The reason, as a sentence, why Box2D cannot simulate these frictions of a robot; nothing when it
/// can. It takes the friction of a contact from those of the two surfaces, so a robot that slides
/// on others without friction would also slide on walls.
std::optional<std::string> friction_flaw(const RobotBody& body);

/// The reason, as a sentence, why networks with these inputs cannot run on the robot; nothing when
/// they can: its rings must have the single sensors that the network reads.
std::optional<std::string> misfit(NetworkInputs inputs, const Robot& robot);

/// Moment of inertia, in kg m2, of a plate with the body's outline and mass.
double plate_inertia_of(const RobotBody& body);

/// The points of the robot's ground sensor that are outside its body.
std::vector<Point> ground_points_outside(const Robot& robot);

/// The flavour as it runs on the robot: with the robot's sensor directions, the distance between
/// its wheels, and a speed no higher than its maximum.
Flavour fitted(const Flavour& flavour, const Robot& robot);

}  // namespace swarmsmith
