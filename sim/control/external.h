#pragma once

#include <string_view>
#include <vector>

#include "base/assert.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Modules that only other programs implement. A flavour gives their names, numbers, tokens and
/// ranges; their texts can be read, counted, drawn, and raced with programs. They are never
/// simulated: code that runs control software refuses them first (`complaint_about_running`,
/// controller.h).

struct ExternalBehaviour {
  static constexpr std::string_view kId = "external";

  int number = 0;              ///< in the texts of the flavour
  std::vector<double> values;  ///< of the parameters, in the order of the flavour

  static UsedSenses uses(const Flavour& /*flavour*/) { return {}; }
  static Command act(Senses& /*senses*/, const Flavour& /*flavour*/, BehaviourMemory& /*memory*/,
                     Rng& /*rng*/) {
    SWARMSMITH_ASSERT(false, "an external behaviour is refused before it acts");
    return {};
  }
  friend bool operator==(const ExternalBehaviour&, const ExternalBehaviour&) = default;
};

struct ExternalCondition {
  static constexpr std::string_view kId = "external";
  using Reads = NoReading;

  int number = 0;
  std::vector<double> values;

  static double enabling(const NoReading& /*none*/, const Flavour& /*flavour*/) {
    SWARMSMITH_ASSERT(false, "an external condition is refused before it is asked");
    return 0;
  }
  friend bool operator==(const ExternalCondition&, const ExternalCondition&) = default;
};

}  // namespace swarmsmith
