#include "coordinator/campaign/machine_space.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/assert.h"
#include "base/text/json.h"
#include "base/text/toml_text.h"
#include "coordinator/campaign/internal/module_parameters.h"

namespace swarmsmith {

/// Adds the parameters one by one and stores their indices.
class MachineSpace::Builder : public ModuleParameters {
 public:
  Builder(const Method& method, const Flavour& flavour, Wording words)
      : ModuleParameters(method, flavour, words), method_(method) {}

  /// Adds all states, in the order of the original file: NumStates first.
  void build() {
    const auto max_states = static_cast<int>(method_.max_states);
    if (max_states > 1) {
      state_count_ = add("NumStates", "nstates", Integer{1.0, double(max_states)});
    } else {
      add_fixed("NumStates", "nstates", 1, std::nullopt);
    }
    for (int i = 0; i < max_states; ++i)
      add_state(i);
  }

  std::vector<StateSlot> states_;
  std::size_t state_count_ = kNoParameter;

 private:
  /// The condition that the machine has more states than `i`; none if it always has.
  static std::optional<Expression> has_state(int i) {
    if (i == 0) return std::nullopt;
    return more_than("NumStates", i);
  }

  /// Adds state i: its behaviour, the behaviour's parameters, its transitions.
  void add_state(int i) {
    const std::string suffix = std::to_string(i);
    StateSlot& state = states_.emplace_back();
    state.behaviour = add("S" + suffix, "s" + suffix, choice_of(behaviours()), has_state(i));
    state.modules = add_modules(behaviours(), "S" + suffix, suffix);
    state.transition_count = kNoParameter;
    if (method_.max_states == 1) return;
    // A machine with one state has no transitions, so even state 0 needs more than 1 state.
    const Expression has_other = more_than("NumStates", std::max(i, 1));
    if (method_.max_transitions > 1) {
      state.transition_count = add("NumConnections" + suffix, "n" + suffix,
                                   Integer{1.0, double(method_.max_transitions)}, has_other);
    } else {
      add_fixed("NumConnections" + suffix, "n" + suffix, 1, has_other);
    }
    for (int j = 0; j < method_.max_transitions; ++j)
      add_transition(state, i, j);
  }

  /// Adds transition j of state i: target, condition, the condition's parameters.
  void add_transition(StateSlot& state, int i, int j) {
    const std::string suffix = std::to_string(i) + "x" + std::to_string(j);
    const Expression active = method_.max_transitions > 1
                                  ? more_than("NumConnections" + std::to_string(i), j)
                                  : more_than("NumStates", std::max(i, 1));
    TransitionSlot& transition = state.transitions.emplace_back();
    transition.target = kNoParameter;
    if (method_.max_states > 2) {
      transition.target = add("N" + suffix, "n" + suffix, Integer{0.0, last_target()}, active);
    } else {
      add_fixed("N" + suffix, "n" + suffix, 0, active);
    }
    transition.condition = add("C" + suffix, "c" + suffix, choice_of(conditions()), active);
    transition.modules = add_modules(conditions(), "C" + suffix, suffix);
  }

  /// Targets are numbered among the other states, hence NumStates - 2. R evaluates this for
  /// machines with one state too, and fails if a bound is negative.
  Expression last_target() const {
    Expression last = Expression::call(Operation::Subtract,
                                       {Expression::parameter("NumStates"), Expression::number(2)});
    if (words() == Wording::Names) return last;
    return Expression::call(Operation::Max, {Expression::number(0), std::move(last)});
  }

  const Method& method_;
};

Expected<MachineSpace> MachineSpace::make(const Method& method, const Flavour& flavour,
                                          int digits) {
  Builder builder(method, flavour, Wording::Names);
  builder.build();
  auto space = ParameterSpace::make(builder.take(), {}, digits);
  if (!space) return Unexpected(space.error());
  MachineSpace built(std::move(*space));
  built.flavour_ = &flavour;
  built.state_count_ = builder.state_count_;
  built.states_ = std::move(builder.states_);
  return built;
}

Expected<ParameterSpace> MachineSpace::in_grammar(const Method& method, const Flavour& flavour,
                                                  int digits) {
  Builder builder(method, flavour, Wording::Grammar);
  builder.build();
  return ParameterSpace::make(builder.take(), {}, digits);
}

Machine MachineSpace::to_machine(const Configuration& configuration) const {
  Machine machine;
  const int states = static_cast<int>(value_or(configuration, state_count_, 1));
  for (int i = 0; i < states; ++i) {
    const StateSlot& slot = states_[static_cast<std::size_t>(i)];
    const ModuleSlot& behaviour = slot.modules[configuration.choice(slot.behaviour)];
    State& state = machine.states.emplace_back(State{
        make_behaviour(behaviour.spec->module, values_of(configuration, behaviour, *flavour_)),
        {}});
    const double otherwise = states > 1 ? 1 : 0;
    const auto transitions =
        static_cast<std::size_t>(value_or(configuration, slot.transition_count, otherwise));
    for (std::size_t j = 0; j < transitions; ++j) {
      const TransitionSlot& transition = slot.transitions[j];
      const ModuleSlot& condition = transition.modules[configuration.choice(transition.condition)];
      const int other = static_cast<int>(value_or(configuration, transition.target, 0));
      state.transitions.push_back(
          {make_condition(condition.spec->module, values_of(configuration, condition, *flavour_)),
           other < i ? other : other + 1});
    }
  }
  return machine;
}

Configuration MachineSpace::from_machine(const Machine& machine) const {
  Configuration configuration(space_.size());
  if (state_count_ != kNoParameter)
    configuration.set(state_count_, static_cast<double>(machine.states.size()));
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    const StateSlot& slot = states_.at(i);
    const State& state = machine.states[i];
    configuration.set(
        slot.behaviour,
        static_cast<double>(put_module(module_of(state.behaviour), parameters_of(state.behaviour),
                                       slot.modules, *flavour_, configuration)));
    if (slot.transition_count != kNoParameter && machine.states.size() > 1)
      configuration.set(slot.transition_count, static_cast<double>(state.transitions.size()));
    for (std::size_t j = 0; j < state.transitions.size(); ++j) {
      const TransitionSlot& to = slot.transitions.at(j);
      const auto& [condition, target] = state.transitions[j];
      // With two states, the target is always the other one, without an active parameter.
      if (to.target != kNoParameter)
        configuration.set(to.target, target < static_cast<int>(i) ? target : target - 1);
      configuration.set(to.condition, static_cast<double>(
                                          put_module(module_of(condition), parameters_of(condition),
                                                     to.modules, *flavour_, configuration)));
    }
  }
  return configuration;
}

std::string parameters_json(const ParameterSpace& space, const Configuration& configuration) {
  JsonObject object;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    const Scalar value = space.scalar(i, configuration[i]);
    const bool is_text = value.type == Scalar::Type::Text;
    // The values of programs may have any bytes, which the store's digest covers: none is replaced.
    object.add(space[i].name,
               JsonPiece{is_text ? quoted_text(value.text) : to_fixed_text(value.number)});
  }
  return object.text();
}

std::vector<std::pair<std::string, int>> module_counts(const Controller& controller,
                                                       const Flavour& flavour) {
  std::map<Module, int> counts;
  if (const auto* machine = std::get_if<Machine>(&controller)) {
    for (const State& state : machine->states) {
      ++counts[module_of(state.behaviour)];
      for (const Transition& transition : state.transitions)
        ++counts[module_of(transition.condition)];
    }
  } else if (const auto* tree = std::get_if<Tree>(&controller)) {
    for (const Subtree& subtree : tree->subtrees) {
      ++counts[module_of(subtree.action)];
      ++counts[module_of(subtree.condition)];
    }
  }
  std::vector<std::pair<std::string, int>> named;
  named.reserve(counts.size());
  for (const auto& [module, count] : counts)
    named.emplace_back(flavour.find(module)->id, count);
  return named;
}

std::string modules_json(const Controller& controller, const Flavour& flavour) {
  JsonObject object;
  for (const auto& [module, count] : module_counts(controller, flavour))
    object.add(module, count);
  return object.text();
}

int transition_count(const Machine& machine) {
  std::size_t count = 0;
  for (const State& state : machine.states)
    count += state.transitions.size();
  return static_cast<int>(count);
}

}  // namespace swarmsmith
