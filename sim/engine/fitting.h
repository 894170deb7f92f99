#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/network.h"
#include "sim/engine/profile.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Why modules of the flavour cannot run on the robot, as a sentence; nothing when they can: they
/// take distances, or strengths, as the robot's sensors give them, and its reference model is one
/// that the robot is simulated with.
std::optional<std::string> misfit(const Flavour& flavour, const Robot& robot);

/// Why the profile cannot be one of the robot, as a sentence; nothing when it can: what does not
/// act on the robot is as in an ideal profile.
std::optional<std::string> misfit(const Profile& profile, const Robot& robot);

/// Why networks with these inputs cannot run on the robot, as a sentence; nothing when they can:
/// its rings have the single sensors that are read.
std::optional<std::string> misfit(NetworkInputs inputs, const Robot& robot);

/// What follows from a body's outline.
struct BodyMeasures {
  double radius_m = 0;             ///< from the centre to the farthest point
  double plate_inertia_kg_m2 = 0;  ///< of a plate with its outline and mass
};
BodyMeasures measures_of(const RobotBody& body);

/// The points of its ground sensor that are outside of the robot's body.
std::vector<Point> ground_points_outside(const Robot& robot);

/// The flavour as it runs on the robot: with the directions that its sensors are taken for, the
/// distance of its wheels, and no faster than it can go.
Flavour fitted(const Flavour& flavour, const Robot& robot);

}  // namespace swarmsmith
