#include "sim/control/machine_control.h"

#include <variant>

#include "base/assert.h"

namespace swarmsmith {
namespace {

bool counts_neighbours(const Condition& condition) {
  return std::holds_alternative<NeighbourCount>(condition) ||
         std::holds_alternative<InvertedNeighbourCount>(condition);
}

}  // namespace

MachineControl::MachineControl(const Machine& machine, const Flavour& flavour, Rng rng)
    : machine_(&machine), flavour_(&flavour), rng_(rng) {
  SWARMSMITH_ASSERT(!machine.states.empty() && machine.states.size() <= kMaxStates,
                    "a machine has 1 to 4 states");
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    const std::vector<Transition>& transitions = machine.states[i].transitions;
    SWARMSMITH_ASSERT(transitions.size() <= kMaxTransitions, "a state has at most 4 transitions");
    for (std::size_t j = 0; j < transitions.size(); ++j) {
      if (counts_neighbours(transitions[j].condition)) sigmoids_[i][j].fill(-1);
    }
  }
}

Command MachineControl::step(Senses& senses) {
  if (entered_) memory_ = {};
  const State& current = machine_->states[static_cast<std::size_t>(state_)];
  const Command command = act(current.behaviour, senses, *flavour_, memory_, rng_);
  if (entered_) {
    entered_ = false;  // no condition is tested in the first cycle of a state
  } else {
    take_transition(senses);
  }
  return command;
}

/// Testing all and choosing uniformly among the enabled ones is, in distribution, the same as
/// visiting them in a random order and taking the first one that is enabled.
void MachineControl::take_transition(Senses& senses) {
  const std::vector<Transition>& transitions =
      machine_->states[static_cast<std::size_t>(state_)].transitions;
  std::array<int, kMaxTransitions> enabled_targets{};
  std::size_t enabled = 0;
  for (std::size_t j = 0; j < transitions.size(); ++j) {
    const double probability = probability_of(transitions[j].condition, j, senses);
    if (probability > 0 && rng_.bernoulli(probability)) {
      enabled_targets[enabled++] = transitions[j].target;
    }
  }
  if (enabled == 0) return;
  state_ = enabled_targets[enabled == 1 ? 0 : rng_.below(enabled)];
  entered_ = true;
}

double MachineControl::probability_of(const Condition& condition, std::size_t transition,
                                      Senses& senses) {
  if (!counts_neighbours(condition)) return enabling_probability(condition, senses, *flavour_);
  const std::size_t n = senses.neighbours().size();
  if (n >= kTabledNeighbours) return enabling_probability(condition, senses, *flavour_);
  double& known = sigmoids_[static_cast<std::size_t>(state_)][transition][n];
  if (known < 0) known = enabling_probability(condition, senses, *flavour_);
  return known;
}

}  // namespace swarmsmith
