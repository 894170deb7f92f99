#include "coordinator/campaign/machine_space.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "base/assert.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The modules of `names`, in the order of the flavour's table.
std::vector<const ModuleSpec*> chosen(const std::vector<ModuleSpec>& table,
                                      const std::vector<std::string>& names) {
  std::vector<const ModuleSpec*> modules;
  for (const ModuleSpec& spec : table) {
    if (std::ranges::find(names, id_of(spec.module)) != names.end()) modules.push_back(&spec);
  }
  return modules;
}

/// How a space's values are written.
enum class Words {
  Names,    ///< modules by name, nothing that has one value alone
  Grammar,  ///< as the text grammar wants them
};

/// The condition `parameter > value`.
Expression more_than(const std::string& parameter, int value) {
  return Expression::call(Operation::Greater,
                          {Expression::parameter(parameter), Expression::number(value)});
}

/// A parameter's value, or `otherwise` where it is left out or inactive.
double value_or(const Configuration& configuration, std::size_t index, double otherwise) {
  if (index == kNone || !configuration.is_active(index)) return otherwise;
  return configuration[index];
}

}  // namespace

SearchRange range_of(const Method& method, Module module, const ParameterSpec& parameter) {
  for (const RangeOverride& range : method.ranges) {
    if (range.module == id_of(module) && range.parameter == parameter.name) {
      return {range.lower, range.upper};
    }
  }
  return {parameter.low, parameter.high};
}

/// Adds the parameters one by one and remembers where they are.
class MachineSpace::Builder {
 public:
  Builder(const Method& method, const Flavour& flavour, Words words)
      : method_(method),
        words_(words),
        behaviours_(chosen(flavour.behaviours, method.behaviours)),
        conditions_(chosen(flavour.conditions, method.conditions)) {}

  /// All states, in the order of the original's file: NumStates first.
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

  std::vector<Parameter> parameters;
  std::vector<StateSlot> states_;
  std::size_t state_count_ = kNone;

 private:
  /// Adds one parameter; returns where it is.
  std::size_t add(std::string name, const std::string& token, Domain domain,
                  std::optional<Expression> condition = std::nullopt) {
    parameters.push_back(
        {std::move(name), "--" + token + " ", std::move(domain), std::move(condition)});
    return parameters.size() - 1;
  }

  /// What has one value alone is for the text grammar only.
  void add_fixed(std::string name, const std::string& token, int value,
                 std::optional<Expression> condition) {
    if (words_ == Words::Names) return;
    add(std::move(name), token, Categorical{{std::to_string(value)}}, std::move(condition));
  }

  /// A module as a value of the space.
  std::string word_of(const ModuleSpec& module) const {
    return words_ == Words::Names ? std::string(id_of(module.module))
                                  : std::to_string(module.number);
  }

  /// A choice among modules.
  Categorical choice_of(const std::vector<const ModuleSpec*>& modules) const {
    Categorical domain;
    for (const ModuleSpec* module : modules)
      domain.values.push_back(word_of(*module));
    return domain;
  }

  /// True while the machine has more states than `i`; nothing when it always has.
  static std::optional<Expression> has_state(int i) {
    if (i == 0) return std::nullopt;
    return more_than("NumStates", i);
  }

  /// State i: its behaviour, the behaviour's parameters, its transitions.
  void add_state(int i) {
    const std::string suffix = std::to_string(i);
    StateSlot& state = states_.emplace_back();
    state.behaviour = add("S" + suffix, "s" + suffix, choice_of(behaviours_), has_state(i));
    state.modules = add_modules(behaviours_, "S" + suffix, suffix);
    state.transition_count = kNone;
    if (method_.max_states == 1) return;
    // A machine of one state has no transition, hence at least 1 even for state 0.
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

  /// Transition j of state i: target, condition, the condition's parameters.
  void add_transition(StateSlot& state, int i, int j) {
    const std::string suffix = std::to_string(i) + "x" + std::to_string(j);
    const Expression active = method_.max_transitions > 1
                                  ? more_than("NumConnections" + std::to_string(i), j)
                                  : more_than("NumStates", std::max(i, 1));
    TransitionSlot& transition = state.transitions.emplace_back();
    transition.target = kNone;
    if (method_.max_states > 2) {
      transition.target = add("N" + suffix, "n" + suffix, Integer{0.0, last_target()}, active);
    } else {
      add_fixed("N" + suffix, "n" + suffix, 0, active);
    }
    transition.condition = add("C" + suffix, "c" + suffix, choice_of(conditions_), active);
    transition.modules = add_modules(conditions_, "C" + suffix, suffix);
  }

  /// Targets count the other states, hence NumStates - 2. R evaluates this for machines of one
  /// state too, and stops at a negative bound.
  Expression last_target() const {
    Expression last = Expression::call(Operation::Subtract,
                                       {Expression::parameter("NumStates"), Expression::number(2)});
    if (words_ == Words::Names) return last;
    return Expression::call(Operation::Max, {Expression::number(0), std::move(last)});
  }

  /// The parameters of the modules among which `chooser` chooses. Modules share a parameter of the
  /// same symbol (P of all conditions with a probability) as long as their ranges agree; one with a
  /// range of its own gets a parameter of its own (P_black_floor0x1).
  std::vector<ModuleSlot> add_modules(const std::vector<const ModuleSpec*>& modules,
                                      const std::string& chooser, const std::string& suffix) {
    std::vector<ModuleSlot> slots;
    for (const ModuleSpec* module : modules) {
      ModuleSlot& slot = slots.emplace_back();
      slot.spec = module;
      for (const ParameterSpec& parameter : module->parameters) {
        const std::string name = name_of(*module, parameter) + suffix;
        const auto known = std::ranges::find(parameters, name, &Parameter::name);
        if (known != parameters.end()) {
          slot.parameters.push_back(static_cast<std::size_t>(known - parameters.begin()));
          continue;
        }
        slot.parameters.push_back(add(name, parameter.token + suffix, domain_of(*module, parameter),
                                      users_chosen(modules, name_of(*module, parameter), chooser)));
      }
    }
    return slots;
  }

  /// The parameter's name without state and transition.
  std::string name_of(const ModuleSpec& module, const ParameterSpec& parameter) const {
    const SearchRange own{parameter.low, parameter.high};
    if (range_of(method_, module.module, parameter) == own) return parameter.symbol;
    if (!is_shared(parameter)) return parameter.symbol;
    return parameter.symbol + "_" + std::string(id_of(module.module));
  }

  /// Whether another condition or behaviour has a parameter of this symbol.
  bool is_shared(const ParameterSpec& parameter) const {
    int users = 0;
    for (const auto* modules : {&behaviours_, &conditions_}) {
      for (const ModuleSpec* module : *modules) {
        users += static_cast<int>(
            std::ranges::count(module->parameters, parameter.symbol, &ParameterSpec::symbol));
      }
    }
    return users > 1;
  }

  /// What is searched: the flavour's own range or the method's.
  Domain domain_of(const ModuleSpec& module, const ParameterSpec& parameter) const {
    const SearchRange range = range_of(method_, module.module, parameter);
    if (parameter.type == ParameterSpec::Type::Real) return Real{range.lower, range.upper};
    return Integer{range.lower, range.upper};
  }

  /// `chooser` has chosen one of the modules with a parameter of this name.
  Expression users_chosen(const std::vector<const ModuleSpec*>& modules, const std::string& name,
                          const std::string& chooser) const {
    std::vector<Expression> users;
    for (const ModuleSpec* module : modules) {
      for (const ParameterSpec& parameter : module->parameters) {
        if (name_of(*module, parameter) != name) continue;
        users.push_back(Expression::text(word_of(*module)));
      }
    }
    if (users.size() > 1) return Expression::in(Expression::parameter(chooser), std::move(users));
    return Expression::call(Operation::Equal, {Expression::parameter(chooser), users.front()});
  }

  const Method& method_;
  Words words_;
  std::vector<const ModuleSpec*> behaviours_;
  std::vector<const ModuleSpec*> conditions_;
};

Expected<MachineSpace> MachineSpace::make(const Method& method, const Flavour& flavour,
                                          int digits) {
  Builder builder(method, flavour, Words::Names);
  builder.build();
  auto space = ParameterSpace::make(std::move(builder.parameters), {}, digits);
  if (!space) return Unexpected(space.error());
  MachineSpace built(std::move(*space));
  built.flavour_ = &flavour;
  built.state_count_ = builder.state_count_;
  built.states_ = std::move(builder.states_);
  return built;
}

Expected<ParameterSpace> MachineSpace::in_grammar(const Method& method, const Flavour& flavour,
                                                  int digits) {
  Builder builder(method, flavour, Words::Grammar);
  builder.build();
  return ParameterSpace::make(std::move(builder.parameters), {}, digits);
}

std::vector<double> MachineSpace::values_of(const Configuration& configuration,
                                            const ModuleSlot& slot) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < slot.parameters.size(); ++i) {
    double value = configuration[slot.parameters[i]];
    if (slot.spec->parameters[i].type == ParameterSpec::Type::Label) {
      // A label's number becomes the enumerator's index, which is what modules are made from.
      const auto& labels = flavour_->floor.labels;
      const auto found = std::ranges::find(labels, static_cast<int>(value), &LabelSpec::number);
      SWARMSMITH_ASSERT(found != labels.end(), "a flavour has every label of its search range");
      value = static_cast<double>(static_cast<int>(found->label));
    }
    values.push_back(value);
  }
  return values;
}

Machine MachineSpace::to_machine(const Configuration& configuration) const {
  Machine machine;
  const int states = static_cast<int>(value_or(configuration, state_count_, 1));
  for (int i = 0; i < states; ++i) {
    const StateSlot& slot = states_[static_cast<std::size_t>(i)];
    const ModuleSlot& behaviour = slot.modules[configuration.choice(slot.behaviour)];
    State& state = machine.states.emplace_back(
        State{make_behaviour(behaviour.spec->module, values_of(configuration, behaviour)), {}});
    const double otherwise = states > 1 ? 1 : 0;
    const auto transitions =
        static_cast<std::size_t>(value_or(configuration, slot.transition_count, otherwise));
    for (std::size_t j = 0; j < transitions; ++j) {
      const TransitionSlot& transition = slot.transitions[j];
      const ModuleSlot& condition = transition.modules[configuration.choice(transition.condition)];
      const int other = static_cast<int>(value_or(configuration, transition.target, 0));
      state.transitions.push_back(
          {make_condition(condition.spec->module, values_of(configuration, condition)),
           other < i ? other : other + 1});
    }
  }
  return machine;
}

std::string parameters_json(const ParameterSpace& space, const Configuration& configuration) {
  std::string text = "{";
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    if (text.size() > 1) text += ",";
    text += "\"" + space[i].name + "\":";
    const Scalar value = space.scalar(i, configuration[i]);
    const bool is_text = value.type == Scalar::Type::Text;
    text += is_text ? quoted_text(value.text) : to_fixed_text(value.number);
  }
  return text + "}";
}

std::vector<std::pair<std::string, int>> module_counts(const Machine& machine) {
  std::map<Module, int> counts;
  for (const State& state : machine.states) {
    ++counts[module_of(state.behaviour)];
    for (const Transition& transition : state.transitions)
      ++counts[module_of(transition.condition)];
  }
  std::vector<std::pair<std::string, int>> named;
  named.reserve(counts.size());
  for (const auto& [module, count] : counts)
    named.emplace_back(id_of(module), count);
  return named;
}

std::string modules_json(const Machine& machine) {
  std::string text = "{";
  for (const auto& [module, count] : module_counts(machine)) {
    if (text.size() > 1) text += ",";
    text += "\"" + module + "\":" + std::to_string(count);
  }
  return text + "}";
}

int transition_count(const Machine& machine) {
  std::size_t count = 0;
  for (const State& state : machine.states)
    count += state.transitions.size();
  return static_cast<int>(count);
}

}  // namespace swarmsmith
