#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// A controller with the flavour that says what its modules do.
struct RobotMachine {
  Flavour flavour;
  Controller controller;
};

/// By a word of the command line: a text of the grammar, or a file with one machine. What its head
/// says of flavour and turn clock needs no flag; flags (empty: not given) win over it.
Expected<RobotMachine> robot_machine(const std::string& word, std::string flavour,
                                     std::optional<TurnClock> turn_clock);

}  // namespace swarmsmith
