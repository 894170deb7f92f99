#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"

namespace swarmsmith {

struct Flavour;

/// An outgoing transition: when its condition enables it, the machine may go to state `target`.
struct Transition {
  Condition condition;
  int target = 0;  ///< index into all states of the machine, never the own one

  friend bool operator==(const Transition&, const Transition&) = default;
};

struct State {
  Behaviour behaviour;
  std::vector<Transition> transitions;  ///< none: a final state

  friend bool operator==(const State&, const State&) = default;
};

/// A probabilistic finite state machine: the control software of one robot, as a value. State 0 is
/// the initial one.
struct Machine {
  std::vector<State> states;

  friend bool operator==(const Machine&, const Machine&) = default;
};

/// Whether transitions lead to each state from the initial one. Search often leaves states to which
/// none does: they are part of the text, and of no behaviour.
std::vector<bool> reachable_states(const Machine& machine);

/// What is wrong with the machine, if anything: number of states and transitions, targets, modules
/// that the flavour lacks, parameters out of their limits. `where` names the state and transition.
std::optional<Error> check(const Machine& machine, const Flavour& flavour);

}  // namespace swarmsmith
