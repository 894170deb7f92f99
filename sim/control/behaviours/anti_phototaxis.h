#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Moves away from the light and from obstacles (thesis eq. 5.2).
struct AntiPhototaxis {
  static constexpr std::string_view kId = "anti_phototaxis";
  static constexpr std::string_view kLabel = "Anti-\nphototaxis";

  template <class Self, class Visitor>
  static void parameters(Self& /*self*/, Visitor& /*visitor*/) {}
  static UsedSenses uses(const Flavour& flavour) {
    return UsedSenses{.light = true} | senses_of_avoidance(flavour);
  }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const AntiPhototaxis&, const AntiPhototaxis&) = default;
};

}  // namespace swarmsmith
