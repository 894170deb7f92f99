#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Moves towards the light and away from obstacles (thesis eq. 5.1).
struct Phototaxis {
  static constexpr std::string_view kId = "phototaxis";
  static constexpr std::string_view kLabel = "Phototaxis";

  template <class Self, class Visitor>
  static void parameters(Self& /*self*/, Visitor& /*visitor*/) {}
  static UsedSenses uses(const Flavour& flavour) {
    return UsedSenses{.light = true} | senses_of_avoidance(flavour);
  }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const Phototaxis&, const Phototaxis&) = default;
};

}  // namespace swarmsmith
