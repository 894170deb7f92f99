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

/// The parameter space of a method: the machines that its flavour's modules can be put together to
/// (rvr-automode facts, section 6.4; 149 parameters for everything that `watermelon` has). Names,
/// switches, ranges and order are those of AutoMoDe's irace files, but modules are values by name
/// (`black_floor`, not 0), so that a number never leaves the flavour's table. A parameter that
/// could have one value alone is left out.
class MachineSpace {
 public:
  /// `digits`: decimals of reals. Fails when a range cannot be kept with these digits.
  static Expected<MachineSpace> make(const Method& method, const Flavour& flavour, int digits);

  /// The same space in the words of the text grammar, as AutoMoDe's irace files have it: switches
  /// and values of the active parameters, put together, are the text of a machine. Modules are
  /// values by the flavour's number, what could have one value alone is there too, and bounds can
  /// be computed for inactive parameters, which R does (irace facts, 8.3).
  static Expected<ParameterSpace> in_grammar(const Method& method, const Flavour& flavour,
                                             int digits);

  const ParameterSpace& parameters() const { return space_; }

  /// The machine of a configuration of this space, which must be valid (`ParameterSpace::check`).
  Machine to_machine(const Configuration& configuration) const;
  /// The configuration of a machine that is in the space: of the method's modules and within its
  /// limits and digits.
  Configuration from_machine(const Machine& machine) const;

 private:
  /// The parameters of one state or one transition. Indices are kNoParameter for omitted
  /// ones.
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

/// A parameter's range as the method has it: the flavour's own, or the override.
struct SearchRange {
  double lower = 0;
  double upper = 0;

  friend bool operator==(const SearchRange&, const SearchRange&) = default;
};
SearchRange range_of(const Method& method, const ModuleSpec& module,
                     const ParameterSpec& parameter);

/// The active parameters as a JSON object, in the space's order: choices as texts.
std::string parameters_json(const ParameterSpace& space, const Configuration& configuration);

/// How often the control software has each module: by id, in the order of the flavours' tables; a
/// network has none.
std::vector<std::pair<std::string, int>> module_counts(const Controller& controller,
                                                       const Flavour& flavour);
/// The same as a JSON object.
std::string modules_json(const Controller& controller, const Flavour& flavour);

/// The number of transitions of all states.
int transition_count(const Machine& machine);

}  // namespace swarmsmith
