#include "sim/control/machine.h"

#include <cstddef>
#include <string>

#include "base/plain_text.h"
#include "sim/control/flavour.h"
#include "sim/control/internal/module_text.h"

namespace swarmsmith {
namespace {

std::optional<Error> check_state(const Machine& machine, std::size_t index,
                                 const Flavour& flavour) {
  const State& state = machine.states[index];
  const std::string where = "state " + std::to_string(index);
  if (auto complaint = complaint_about_module(module_of(state.behaviour),
                                              parameters_of(state.behaviour), flavour)) {
    return Error{ErrorKind::BadInput, *complaint, where};
  }
  if (static_cast<int>(state.transitions.size()) > flavour.most_transitions) {
    return Error{ErrorKind::BadInput,
                 "a state has at most " + counted(flavour.most_transitions, "transition"), where};
  }
  for (std::size_t j = 0; j < state.transitions.size(); ++j) {
    const Transition& transition = state.transitions[j];
    const std::string place = where + ", transition " + std::to_string(j);
    const int states = static_cast<int>(machine.states.size());
    if (transition.target < 0 || transition.target >= states) {
      return Error{ErrorKind::BadInput,
                   "the target " + std::to_string(transition.target) + " is not a state", place};
    }
    if (transition.target == static_cast<int>(index)) {
      return Error{ErrorKind::BadInput, "a transition must lead to another state", place};
    }
    if (auto complaint = complaint_about_module(module_of(transition.condition),
                                                parameters_of(transition.condition), flavour)) {
      return Error{ErrorKind::BadInput, *complaint, place};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<bool> reachable_states(const Machine& machine) {
  std::vector<bool> reached(machine.states.size());
  std::vector<std::size_t> next = {0};
  while (!next.empty()) {
    const std::size_t state = next.back();
    next.pop_back();
    if (reached[state]) continue;
    reached[state] = true;
    for (const Transition& transition : machine.states[state].transitions)
      next.push_back(static_cast<std::size_t>(transition.target));
  }
  return reached;
}

std::optional<Error> check(const Machine& machine, const Flavour& flavour) {
  if (machine.states.empty() || static_cast<int>(machine.states.size()) > flavour.most_states) {
    return Error{ErrorKind::BadInput,
                 "a machine has 1 to " + std::to_string(flavour.most_states) + " states", ""};
  }
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    if (auto error = check_state(machine, i, flavour)) return error;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
