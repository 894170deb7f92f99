#pragma once

#include <string_view>

#include "sim/control/behaviours/random_walk.h"
#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// A Levy walk: straight steps whose lengths follow a power law, and turns between them whose
/// angles follow a wrapped Cauchy distribution (Dimidov et al., ANTS 2016).
struct LevyWalk {
  static constexpr std::string_view kId = "levy_walk";
  static constexpr std::string_view kLabel = "Levy walk";

  double mu = 2;   ///< P(length) ~ length^-mu: nearly ballistic for mu near 1, like Brownian motion
                   ///< for mu >= 3
  double rho = 0;  ///< 0: the new direction is uniform; 1: straight on

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(ParameterSpec{.name = "mu",
                          .symbol = "MU",
                          .token = "mu",
                          .type = ParameterSpec::Type::Real,
                          .low = 1.1,
                          .high = 3,
                          .digits = 2,
                          .least = 1,
                          .most = 100,
                          .least_included = false},
            self.mu);
    visitor(rho_parameter(), self.rho);
  }
  static UsedSenses uses(const Flavour& flavour) { return senses_of_avoidance(flavour); }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const LevyWalk&, const LevyWalk&) = default;
};

}  // namespace swarmsmith
