#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// A controller with the flavour of its modules.
struct RobotMachine {
  Flavour flavour;
  Controller controller;
};

/// Reads a controller from an argument of the command line: its text, or a file with one machine.
/// Flavour and turn clock come from the head of the file, unless flags set them (empty: not given).
/// BadInput if the machine is for another robot than `kind`.
Expected<RobotMachine> robot_machine(const std::string& word, std::string flavour,
                                     std::optional<TurnClock> turn_clock, const Robot& kind);

/// Reads a robot from an argument, a built-in name or a file; BadInput if no node drives it.
Expected<Robot> find_kind(const std::string& word);

}  // namespace swarmsmith
