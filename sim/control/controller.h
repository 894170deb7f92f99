#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/expected.h"
#include "sim/control/machine.h"
#include "sim/control/network.h"
#include "sim/control/tree.h"

namespace swarmsmith {

/// The control software of one robot, as a value: what a method's architecture puts together.
using Controller = std::variant<Machine, Tree, Network>;

/// What is searched: state machines of modules, behaviour trees of modules, or the weights of a
/// neural network.
enum class Architecture { Machine, Tree, Network };

/// `machine`, `tree` or `network`.
std::string_view name_of(Architecture architecture);
Architecture architecture_of(const Controller& controller);

/// Reads a text of any architecture; its first switch says which: `--nstates` or `--fsm-config`,
/// `--nroot` or `--bt-config`, `--network`.
Expected<Controller> parse_controller(std::string_view text, const Flavour& flavour);
/// Whether the text begins as one of a controller; nothing of the rest is looked at.
std::optional<Architecture> architecture_of_text(std::string_view text);
/// The switches that texts begin with, for sentences: "--nstates, --fsm-config, ...".
std::string first_switches();
/// Where a controller's text begins in a line, behind a name or nothing; npos without any.
std::size_t find_controller(std::string_view line);

/// The canonical text. Throws std::invalid_argument when the controller does not fit the flavour.
std::string print_controller(const Controller& controller, const Flavour& flavour);

/// The module that acts in a state (ControlSoftware::state): a machine's behaviour or a tree's
/// action by its id, `network` of a network.
std::string_view acting_in(const Controller& controller, int state);

/// What is wrong with the controller, if anything.
std::optional<Error> check(const Controller& controller, const Flavour& flavour);

/// Why the control software cannot act on the RVR or in its simulation, as a sentence: its flavour
/// is for another robot, or has external modules. Nothing when it can.
std::optional<std::string> complaint_about_running(const Controller& controller,
                                                   const Flavour& flavour);

}  // namespace swarmsmith
