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
  int target = 0;  ///< index among all states of the machine, never the state itself

  friend bool operator==(const Transition&, const Transition&) = default;
};

struct State {
  Behaviour behaviour;
  std::vector<Transition> transitions;  ///< none for a final state

  friend bool operator==(const State&, const State&) = default;
};

/// A probabilistic finite state machine: the control software of one robot, as a value. State 0 is
/// the initial state.
struct Machine {
  std::vector<State> states;

  friend bool operator==(const Machine&, const Machine&) = default;
};

/// For each state, whether it can be reached from the initial state through transitions. A search
/// often leaves unreachable states: they are part of the text but never act.
std::vector<bool> reachable_states(const Machine& machine);

/// The error in the machine, if there is one: number of states and transitions, targets, modules
/// that the flavour does not have, parameters outside their limits. `where` names the state and
/// transition.
std::optional<Error> check(const Machine& machine, const Flavour& flavour);

}  // namespace swarmsmith
