#pragma once

#include <optional>
#include <string>

#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Why modules of the flavour cannot run on the robot, as a sentence; nothing when they can: they
/// take distances, or strengths, as the robot's sensors give them, and its reference model is one
/// that the robot is simulated with.
std::optional<std::string> misfit(const Flavour& flavour, const Robot& robot);

/// Why the profile cannot be one of the robot, as a sentence; nothing when it can: noise is that of
/// what the robot's sensors give.
std::optional<std::string> misfit(const Profile& profile, const Robot& robot);

/// The flavour as it runs on the robot: with the directions that its sensors are taken for.
Flavour fitted(const Flavour& flavour, const Robot& robot);

}  // namespace swarmsmith
