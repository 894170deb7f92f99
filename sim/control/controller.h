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

/// The control software of one robot, as a value; a method's architecture decides which kind it is.
using Controller = std::variant<Machine, Tree, Network>;

/// The kind of controller that is searched: state machines of modules, behaviour trees of modules,
/// or the weights of a neural network.
enum class Architecture { Machine, Tree, Network };

/// `machine`, `tree` or `network`.
std::string_view name_of(Architecture architecture);
Architecture architecture_of(const Controller& controller);

/// Reads the text of a controller of any architecture. The first switch tells which: `--nstates` or
/// `--fsm-config`, `--nroot` or `--bt-config`, `--network`.
Expected<Controller> parse_controller(std::string_view text, const Flavour& flavour);
/// The architecture of the controller that begins with this text, if it begins like one; the rest
/// of the text is not checked.
std::optional<Architecture> architecture_of_text(std::string_view text);
/// The switches with which texts of controllers begin, for use in messages: "--nstates,
/// --fsm-config, ...".
std::string first_switches();
/// The position in a line at which the text of a controller begins, after a name or at the start;
/// npos if there is none.
std::size_t find_controller(std::string_view line);

/// The canonical text. Throws std::invalid_argument when the controller does not fit the flavour.
std::string print_controller(const Controller& controller, const Flavour& flavour);

/// The module that acts in a state (ControlSoftware::state): the id of a machine's behaviour or of
/// a tree's action, or `network` for a network.
std::string_view acting_in(const Controller& controller, int state);

/// The error in the controller, if there is one.
std::optional<Error> check(const Controller& controller, const Flavour& flavour);

/// The reason, as a sentence, why the control software cannot run on the RVR or in its simulation:
/// its flavour is for another robot, or has external modules. Nothing if it can.
std::optional<std::string> complaint_about_running(const Controller& controller,
                                                   const Flavour& flavour);

}  // namespace swarmsmith
