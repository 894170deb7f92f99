#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/plain_text.h"
#include "sim/control/module.h"
#include "sim/control/modules.h"

namespace swarmsmith {

/// Functions derived from the struct of each module. `Modules` is Behaviour or Condition.

/// The number of modules that have their own struct: all alternatives except the last one, which is
/// for external modules.
template <class Modules>
inline constexpr std::size_t kKinds = std::variant_size_v<Modules> - 1;

/// The enumerator of the first module of `Modules`.
template <class Modules>
inline constexpr std::size_t kFirstModule =
    std::is_same_v<Modules, Behaviour> ? 0 : kKinds<Behaviour>;

/// The alternative for external modules.
template <class Modules>
using External = std::variant_alternative_t<kKinds<Modules>, Modules>;

template <class Modules>
Module module_at(std::size_t index) {
  return static_cast<Module>(kFirstModule<Modules> + index);
}

/// Calls `visit(index, module)` for each module that has its own struct; `module` is a
/// default-constructed struct.
template <class Modules, class Visit>
void for_each_module(const Visit& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...> /*indices*/) {
    (visit(I, std::variant_alternative_t<I, Modules>()), ...);
  }
  (std::make_index_sequence<kKinds<Modules>>());
}

template <class Modules>
std::vector<double> values_of(const Modules& module) {
  if (const auto* external = std::get_if<External<Modules>>(&module)) return external->values;
  std::vector<double> values;
  const auto add = [&values](const ParameterSpec& /*parameter*/, const auto& value) {
    values.push_back(static_cast<double>(value));
  };
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (!std::is_same_v<Kind, External<Modules>>) Kind::parameters(kind, add);
      },
      module);
  return values;
}

/// The module with this enumerator and these parameters; nothing when it does not belong to
/// `Modules`. Throws std::invalid_argument if the number of parameters is wrong.
template <class Modules>
std::optional<Modules> made_of(Module wanted, std::span<const double> values) {
  std::optional<Modules> made;
  for_each_module<Modules>([&]<class Kind>(std::size_t index, Kind kind) {
    if (module_at<Modules>(index) != wanted) return;
    std::size_t count = 0;
    const auto set = [&]<class Value>(const ParameterSpec& /*parameter*/, Value& value) {
      if (count < values.size()) value = static_cast<Value>(values[count]);
      ++count;
    };
    Kind::parameters(kind, set);
    if (count != values.size()) {
      throw std::invalid_argument(std::string(Kind::kId) + " takes " + counted(count, "parameter") +
                                  ", not " + std::to_string(values.size()));
    }
    made = kind;
  });
  return made;
}

/// The parameters of a kind of module, with the ranges and names that a flavour uses unless it sets
/// others; empty when the kind has none or does not belong to `Modules`.
template <class Modules>
std::vector<ParameterSpec> parameters_of_kind(Module wanted) {
  std::vector<ParameterSpec> parameters;
  for_each_module<Modules>([&]<class Kind>(std::size_t index, const Kind& kind) {
    if (module_at<Modules>(index) != wanted) return;
    const auto add = [&](const ParameterSpec& parameter, const auto& /*value*/) {
      parameters.push_back(parameter);
    };
    Kind::parameters(kind, add);
  });
  return parameters;
}

}  // namespace swarmsmith
