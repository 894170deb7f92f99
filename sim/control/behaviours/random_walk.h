#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// The parameter rho of random walks: concentration of the turns between steps, 0..1 in the search.
ParameterSpec rho_parameter();

/// A correlated random walk: straight steps whose lengths are exponentially distributed, and turns
/// between them whose angles follow a wrapped Cauchy distribution (Dimidov et al., ANTS 2016).
struct RandomWalk {
  static constexpr std::string_view kId = "random_walk";
  static constexpr std::string_view kLabel = "Random walk";

  double rho = 0;  ///< 0: the new direction is uniform; 1: straight on
  int step = 1;    ///< mean length of a step in control cycles; 1..100 in the search

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(rho_parameter(), self.rho);
    visitor(ParameterSpec{.name = "step",
                          .symbol = "STP",
                          .token = "stp",
                          .type = ParameterSpec::Type::Integer,
                          .low = 1,
                          .high = 100,
                          .digits = 0,
                          .least = 1,
                          .most = kLargestCount},
            self.step);
  }
  static UsedSenses uses(const Flavour& flavour) { return senses_of_avoidance(flavour); }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const RandomWalk&, const RandomWalk&) = default;
};

}  // namespace swarmsmith
