#pragma once

#include <string_view>

#include "sim/control/behaviours/steering.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// The direction in which a robot turns away from an obstacle in front of it.
enum class TurnAway { None, Left, Right };

/// Decides by the flavour's trigger of Exploration; None if there is no obstacle in front.
TurnAway turn_away(Senses& senses, const Flavour& flavour);

/// Drives straight on until there is an obstacle in front, then turns on the spot for a random
/// number of control cycles.
struct Exploration {
  static constexpr std::string_view kId = "exploration";
  static constexpr std::string_view kLabel = "Exploration";

  int tau = 1;  ///< upper bound of the drawn number of turning cycles; 1..100 in the search

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(ParameterSpec{.name = "tau",
                          .symbol = "RWM",
                          .token = "rwm",
                          .type = ParameterSpec::Type::Integer,
                          .low = 1,
                          .high = 100,
                          .digits = 0,
                          .least = 1,
                          .most = kLargestCount},
            self.tau);
  }
  static UsedSenses uses(const Flavour& flavour) { return senses_of_avoidance(flavour); }
  Command act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) const;
  friend bool operator==(const Exploration&, const Exploration&) = default;
};

}  // namespace swarmsmith
