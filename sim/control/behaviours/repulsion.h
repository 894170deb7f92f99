#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Moves away from the neighbours and from obstacles (thesis eq. 5.4, 5.6).
struct Repulsion {
  static constexpr std::string_view kId = "repulsion";
  static constexpr std::string_view kLabel = "Repulsion";

  double alpha = 1;  ///< weight of the neighbours; 1..5 in the search

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(alpha_parameter("REP", "rep"), self.alpha);
  }
  static UsedSenses uses(const Flavour& flavour) {
    return UsedSenses{.neighbours = true} | senses_of_avoidance(flavour);
  }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const Repulsion&, const Repulsion&) = default;
};

}  // namespace swarmsmith
