#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Moves towards the neighbours and away from obstacles (thesis eq. 5.3, 5.5).
struct Attraction {
  static constexpr std::string_view kId = "attraction";
  static constexpr std::string_view kLabel = "Attraction";

  double alpha = 1;  ///< weight of the neighbours; 1..5 in the search

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(alpha_parameter("ATT", "att"), self.alpha);
  }
  static UsedSenses uses(const Flavour& flavour) {
    return UsedSenses{.neighbours = true} | senses_of_avoidance(flavour);
  }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const Attraction&, const Attraction&) = default;
};

}  // namespace swarmsmith
