#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/module_parameters.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"

namespace swarmsmith {

/// The parameter space of a method: all machines that can be built from its flavour's modules
/// (rvr-automode facts, section 6.4; 149 parameters for all modules of `watermelon`). Names,
/// switches, ranges and order are as in AutoMoDe's irace files, but modules are values by name
/// (`black_floor`, not 0), so that the flavour's numbers are used only in its table. Parameters
/// with only one possible value are left out.
class MachineSpace {
 public:
  /// `digits`: decimals of real parameters. Fails if they are not enough for a range.
  static Expected<MachineSpace> make(const Method& method, const Flavour& flavour, int digits);

  /// The same space in the words of the text grammar, as in AutoMoDe's irace files: the switches
  /// and values of the active parameters form the text of a machine. Modules are values by the
  /// flavour's number, parameters with only one possible value are included, and bounds can be
  /// computed for inactive parameters too, because R does so (irace facts, 8.3).
  static Expected<ParameterSpace> in_grammar(const Method& method, const Flavour& flavour,
                                             int digits);

  const ParameterSpace& parameters() const { return space_; }

  /// The machine of a configuration, which must be valid in this space (`ParameterSpace::check`).
  Machine to_machine(const Configuration& configuration) const;
  /// The configuration of a machine, which must be in the space: it uses only the method's modules
  /// and keeps to its limits and digits.
  Configuration from_machine(const Machine& machine) const;

 private:
  /// Parameter indices of one state or transition; kNoParameter for omitted parameters.
  struct TransitionSlot {
    std::size_t target = 0;
    std::size_t condition = 0;
    std::vector<ModuleSlot> modules;
  };
  struct StateSlot {
    std::size_t behaviour = 0;
    std::size_t transition_count = 0;
    std::vector<ModuleSlot> modules;
    std::vector<TransitionSlot> transitions;
  };
  class Builder;

  explicit MachineSpace(ParameterSpace space) : space_(std::move(space)) {}

  ParameterSpace space_;
  const Flavour* flavour_ = nullptr;
  std::size_t state_count_ = 0;
  std::vector<StateSlot> states_;
};

/// The range of a parameter in a method: the flavour's own, or the method's override.
struct SearchRange {
  double lower = 0;
  double upper = 0;

  friend bool operator==(const SearchRange&, const SearchRange&) = default;
};
SearchRange range_of(const Method& method, const ModuleSpec& module,
                     const ParameterSpec& parameter);

/// The active parameters as a JSON object, in the order of the space; categorical values are texts.
std::string parameters_json(const ParameterSpace& space, const Configuration& configuration);

/// How often the control software uses each module: by id, in the order of the flavour's tables;
/// empty for a network.
std::vector<std::pair<std::string, int>> module_counts(const Controller& controller,
                                                       const Flavour& flavour);
/// The same as a JSON object.
std::string modules_json(const Controller& controller, const Flavour& flavour);

/// The total number of transitions of all states.
int transition_count(const Machine& machine);

}  // namespace swarmsmith
