#include "coordinator/campaign/internal/module_parameters.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "coordinator/campaign/machine_space.h"

namespace swarmsmith {
namespace {

/// The modules named in `names`, in the order of the flavour's table.
std::vector<const ModuleSpec*> chosen(const std::vector<ModuleSpec>& table,
                                      const std::vector<std::string>& names) {
  std::vector<const ModuleSpec*> modules;
  for (const ModuleSpec& spec : table) {
    if (std::ranges::find(names, spec.id) != names.end()) modules.push_back(&spec);
  }
  return modules;
}

}  // namespace

Expression more_than(const std::string& parameter, int value) {
  return Expression::call(Operation::Greater,
                          {Expression::parameter(parameter), Expression::number(value)});
}

double value_or(const Configuration& configuration, std::size_t index, double otherwise) {
  if (index == kNoParameter || !configuration.is_active(index)) return otherwise;
  return configuration[index];
}

SearchRange range_of(const Method& method, const ModuleSpec& module,
                     const ParameterSpec& parameter) {
  for (const RangeOverride& range : method.ranges) {
    if (range.module == module.id && range.parameter == parameter.name) {
      return {range.lower, range.upper};
    }
  }
  return {parameter.low, parameter.high};
}

ModuleParameters::ModuleParameters(const Method& method, const Flavour& flavour, Wording words)
    : method_(method),
      words_(words),
      behaviours_(chosen(flavour.behaviours, method.behaviours)),
      conditions_(chosen(flavour.conditions, method.conditions)) {}

std::size_t ModuleParameters::add(std::string name, const std::string& token, Domain domain,
                                  std::optional<Expression> condition) {
  parameters_.push_back(
      {std::move(name), "--" + token + " ", std::move(domain), std::move(condition)});
  return parameters_.size() - 1;
}

void ModuleParameters::add_fixed(std::string name, const std::string& token, int value,
                                 std::optional<Expression> condition) {
  if (words_ == Wording::Names) return;
  add(std::move(name), token, Categorical{{std::to_string(value)}}, std::move(condition));
}

/// A module as a value in the space.
std::string ModuleParameters::word_of(const ModuleSpec& module) const {
  return words_ == Wording::Names ? module.id : std::to_string(module.number);
}

Categorical ModuleParameters::choice_of(const std::vector<const ModuleSpec*>& modules) const {
  Categorical domain;
  for (const ModuleSpec* module : modules)
    domain.values.push_back(word_of(*module));
  return domain;
}

std::vector<ModuleSlot> ModuleParameters::add_modules(const std::vector<const ModuleSpec*>& modules,
                                                      const std::string& chooser,
                                                      const std::string& suffix) {
  std::vector<ModuleSlot> slots;
  for (const ModuleSpec* module : modules) {
    ModuleSlot& slot = slots.emplace_back();
    slot.spec = module;
    for (const ParameterSpec& parameter : module->parameters) {
      const std::string name = name_of(*module, parameter) + suffix;
      const auto known = std::ranges::find(parameters_, name, &Parameter::name);
      if (known != parameters_.end()) {
        slot.parameters.push_back(static_cast<std::size_t>(known - parameters_.begin()));
        continue;
      }
      slot.parameters.push_back(add(name, parameter.token + suffix, domain_of(*module, parameter),
                                    users_chosen(modules, name_of(*module, parameter), chooser)));
    }
  }
  return slots;
}

/// The parameter's name without the suffix for state and transition.
std::string ModuleParameters::name_of(const ModuleSpec& module,
                                      const ParameterSpec& parameter) const {
  const SearchRange own{parameter.low, parameter.high};
  if (range_of(method_, module, parameter) == own) return parameter.symbol;
  if (!is_shared(parameter)) return parameter.symbol;
  return parameter.symbol + "_" + module.id;
}

/// Whether another condition or behaviour has a parameter of this symbol.
bool ModuleParameters::is_shared(const ParameterSpec& parameter) const {
  int users = 0;
  for (const auto* modules : {&behaviours_, &conditions_}) {
    for (const ModuleSpec* module : *modules) {
      users += static_cast<int>(
          std::ranges::count(module->parameters, parameter.symbol, &ParameterSpec::symbol));
    }
  }
  return users > 1;
}

/// The domain that is searched: the flavour's own range, or the method's.
Domain ModuleParameters::domain_of(const ModuleSpec& module, const ParameterSpec& parameter) const {
  const SearchRange range = range_of(method_, module, parameter);
  if (parameter.type == ParameterSpec::Type::Real) return Real{range.lower, range.upper};
  return Integer{range.lower, range.upper};
}

/// The condition that `chooser` has chosen one of the modules with a parameter of this name.
Expression ModuleParameters::users_chosen(const std::vector<const ModuleSpec*>& modules,
                                          const std::string& name,
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

std::vector<double> values_of(const Configuration& configuration, const ModuleSlot& slot,
                              const Flavour& flavour) {
  std::vector<double> values;
  for (std::size_t i = 0; i < slot.parameters.size(); ++i) {
    double value = configuration[slot.parameters[i]];
    if (slot.spec->parameters[i].type == ParameterSpec::Type::Label) {
      // The label's number becomes the index of its enumerator, from which modules are made.
      const auto& labels = flavour.floor.labels;
      const auto found = std::ranges::find(labels, static_cast<int>(value), &LabelSpec::number);
      SWARMSMITH_ASSERT(found != labels.end(), "a flavour has every label of its search range");
      value = static_cast<double>(static_cast<int>(found->label));
    }
    values.push_back(value);
  }
  return values;
}

std::size_t put_module(Module module, const std::vector<double>& parameters,
                       const std::vector<ModuleSlot>& slots, const Flavour& flavour,
                       Configuration& values) {
  const auto slot =
      std::ranges::find(slots, module, [](const ModuleSlot& s) { return s.spec->module; });
  SWARMSMITH_ASSERT(slot != slots.end(), "the method has the module");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    double value = parameters[i];
    if (slot->spec->parameters[i].type == ParameterSpec::Type::Label) {
      // The index of the enumerator becomes the label's number.
      const auto label = static_cast<ColorLabel>(static_cast<int>(value));
      const auto& labels = flavour.floor.labels;
      const auto found = std::ranges::find(labels, label, &LabelSpec::label);
      SWARMSMITH_ASSERT(found != labels.end(), "a flavour has every label of its search range");
      value = found->number;
    }
    values.set(slot->parameters[i], value);
  }
  return static_cast<std::size_t>(slot - slots.begin());
}

}  // namespace swarmsmith
