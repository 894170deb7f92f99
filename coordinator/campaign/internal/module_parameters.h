#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// The index of a parameter that is left out.
inline constexpr std::size_t kNoParameter = std::numeric_limits<std::size_t>::max();

/// How the values of a space are written.
enum class Wording {
  Names,    ///< modules by name, without parameters that have only one value
  Grammar,  ///< as in the text grammar
};

/// The indices of one module's parameters in the space, in the order of `parameters_of`.
struct ModuleSlot {
  const ModuleSpec* spec = nullptr;
  std::vector<std::size_t> parameters;
};

/// Builds the parameters of a space from a flavour's modules, one by one.
class ModuleParameters {
 public:
  ModuleParameters(const Method& method, const Flavour& flavour, Wording words);

  /// Adds one parameter; returns its index.
  std::size_t add(std::string name, const std::string& token, Domain domain,
                  std::optional<Expression> condition = std::nullopt);
  /// Adds a parameter with only one value, which only the text grammar needs.
  void add_fixed(std::string name, const std::string& token, int value,
                 std::optional<Expression> condition);
  /// A categorical domain with the modules as values.
  Categorical choice_of(const std::vector<const ModuleSpec*>& modules) const;
  /// Adds the parameters of the modules among which `chooser` chooses. Modules share a parameter
  /// with the same symbol (P of all conditions with a probability) if their ranges are equal; a
  /// module with a different range gets its own parameter (P_black_floor0x1).
  std::vector<ModuleSlot> add_modules(const std::vector<const ModuleSpec*>& modules,
                                      const std::string& chooser, const std::string& suffix);

  const std::vector<const ModuleSpec*>& behaviours() const { return behaviours_; }
  const std::vector<const ModuleSpec*>& conditions() const { return conditions_; }
  Wording words() const { return words_; }
  std::vector<Parameter> take() { return std::move(parameters_); }

 private:
  std::string word_of(const ModuleSpec& module) const;
  std::string name_of(const ModuleSpec& module, const ParameterSpec& parameter) const;
  bool is_shared(const ParameterSpec& parameter) const;
  Domain domain_of(const ModuleSpec& module, const ParameterSpec& parameter) const;
  Expression users_chosen(const std::vector<const ModuleSpec*>& modules, const std::string& name,
                          const std::string& chooser) const;

  const Method& method_;
  Wording words_;
  std::vector<const ModuleSpec*> behaviours_;
  std::vector<const ModuleSpec*> conditions_;
  std::vector<Parameter> parameters_;
};

/// The condition `parameter > value`.
Expression more_than(const std::string& parameter, int value);

/// A parameter's value, or `otherwise` if it is left out or inactive.
double value_or(const Configuration& configuration, std::size_t index, double otherwise);

/// The module's parameters in a configuration, as arguments of make_behaviour and make_condition.
std::vector<double> values_of(const Configuration& configuration, const ModuleSlot& slot,
                              const Flavour& flavour);
/// The reverse: returns the index of the slot for the module, as the chooser's value, and writes
/// the module's parameters to `values`.
std::size_t put_module(Module module, const std::vector<double>& parameters,
                       const std::vector<ModuleSlot>& slots, const Flavour& flavour,
                       Configuration& values);

}  // namespace swarmsmith
