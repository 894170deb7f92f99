#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "sim/control/machine.h"

namespace swarmsmith {

/// The text grammar of AutoMoDe's machines (rvr-automode facts, section 6.3), the field's exchange
/// format:
///
///     --nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 0 --p0x0 1 --s1 1
///
/// The numbers of modules and labels are the numbers in the flavour's tables. `--n0x0 D` names the
/// D-th of the *other* states.

/// Reads a machine. A leading `--fsm-config` is skipped. Within the block of a state (from `--s0`
/// to `--s1`) and within the block of a transition (from `--n0x0` to `--n0x1`) the order is free.
/// Anything else is an error: unknown, missing and repeated tokens, tokens in the wrong block,
/// malformed numbers, parameters outside their limits. `where` is "token 5, column 31", both
/// counted from 1.
Expected<Machine> parse_machine(std::string_view text, const Flavour& flavour);

/// The canonical text: in a fixed order, with each number in the shortest form that reads back to
/// the same value. Throws std::invalid_argument when the machine does not fit the flavour
/// (`check`).
std::string print_machine(const Machine& machine, const Flavour& flavour);

}  // namespace swarmsmith
