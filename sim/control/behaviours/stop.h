#pragma once

#include <string_view>

#include "sim/control/module_parts.h"

namespace swarmsmith {

/// The robot stands still.
struct Stop {
  static constexpr std::string_view kId = "stop";
  static constexpr std::string_view kLabel = "Stop";

  template <class Self, class Visitor>
  static void parameters(Self& /*self*/, Visitor& /*visitor*/) {}
  static UsedSenses uses(const Flavour& /*flavour*/) { return {}; }
  static Command act(Senses& /*senses*/, const Flavour& /*flavour*/, BehaviourMemory& /*memory*/,
                     Rng& /*rng*/) {
    return {0, 0};
  }
  friend bool operator==(const Stop&, const Stop&) = default;
};

}  // namespace swarmsmith
