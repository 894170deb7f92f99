#include "sim/control/machine_control.h"

#include <cstdint>
#include <type_traits>
#include <variant>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// A colour as one number. It is read byte by byte, because the three bytes were often just written
/// one by one, and code that reads two of them at once then stalls.
std::uint32_t number_of(const Rgb& color) {
  return static_cast<std::uint32_t>(color.r) | static_cast<std::uint32_t>(color.g) << 8U |
         static_cast<std::uint32_t>(color.b) << 16U;
}

}  // namespace

MachineControl::MachineControl(const Machine& machine, const Flavour& flavour, Rng rng)
    : machine_(&machine), flavour_(&flavour), rng_(rng) {
  SWARMSMITH_ASSERT(!machine.states.empty(), "a machine has a state");
  known_.resize(machine.states.size());
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    const std::vector<Transition>& transitions = machine.states[i].transitions;
    SWARMSMITH_ASSERT(transitions.size() <= kMaxTransitions, "a state has at most 16 transitions");
    for (const Transition& transition : transitions)
      known_[i].push_back(known_of(transition.condition, flavour));
  }
}

/// Sorts conditions by the type of their reading: the probability depends on nothing else.
MachineControl::Known MachineControl::known_of(const Condition& condition, const Flavour& flavour) {
  Known known;
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        using What = typename Kind::Reads;
        if constexpr (std::is_same_v<What, NoReading>) {
          known.probability = kind.enabling(NoReading{}, flavour);
        } else if constexpr (std::is_same_v<What, FloorReading>) {
          known.reads = Reads::Floor;
        } else if constexpr (std::is_same_v<What, NeighbourTally>) {
          known.reads = Reads::Neighbours;
          known.by_count.fill(-1);
        } else {
          known.reads = Reads::Others;
        }
      },
      condition);
  return known;
}

Command MachineControl::step(Senses& senses) {
  if (entered_) memory_ = {};
  const State& current = machine_->states[static_cast<std::size_t>(state_)];
  const Command command = act(current.behaviour, senses, *flavour_, memory_, rng_);
  if (entered_) {
    entered_ = false;  // conditions are not tested in the first cycle of a state
  } else {
    take_transition(senses);
  }
  return command;
}

/// Inlined into the loop over transitions: a call would cost more than the function itself.
[[gnu::always_inline]] inline double MachineControl::probability_of_count(
    Known& known, const Condition& condition, Senses& senses) const {
  const auto n = static_cast<std::size_t>(senses.neighbour_count());
  if (n >= kTabledNeighbours) return enabling_probability(condition, senses, *flavour_);
  double& probability = known.by_count[n];
  if (probability < 0) probability = enabling_probability(condition, senses, *flavour_);
  return probability;
}

/// Testing all transitions and choosing uniformly among the enabled ones has the same distribution
/// as visiting them in random order and taking the first enabled one.
void MachineControl::take_transition(Senses& senses) {
  const std::vector<Transition>& transitions =
      machine_->states[static_cast<std::size_t>(state_)].transitions;
  std::array<int, kMaxTransitions> enabled_targets;
  std::size_t enabled = 0;
  std::uint32_t color = kNoColor;
  Known* known = known_[static_cast<std::size_t>(state_)].data();
  for (const Transition& transition : transitions) {
    double probability = known->probability;
    if (known->reads == Reads::Floor) {
      if (color == kNoColor) color = number_of(senses.ground_color());
      if (color != known->color) {
        known->color = color;
        known->probability = enabling_probability(transition.condition, senses, *flavour_);
      }
      probability = known->probability;
    } else if (known->reads == Reads::Neighbours) {
      probability = probability_of_count(*known, transition.condition, senses);
    } else if (known->reads == Reads::Others) {
      probability = enabling_probability(transition.condition, senses, *flavour_);
    }
    if (probability > 0 && rng_.bernoulli(probability)) {
      enabled_targets[enabled++] = transition.target;
    }
    ++known;
  }
  if (enabled == 0) return;
  state_ = enabled_targets[enabled == 1 ? 0 : rng_.below(enabled)];
  entered_ = true;
}

}  // namespace swarmsmith
