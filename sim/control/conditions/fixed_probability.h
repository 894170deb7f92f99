#pragma once

#include <string_view>

#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Always true.
struct FixedProbability {
  static constexpr std::string_view kId = "fixed_probability";
  static constexpr std::string_view kLabel = "Fixed probability";
  using Reads = NoReading;

  double probability = 0;  ///< beta, in [0, 1]

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(beta_parameter(), self.probability);
  }
  double enabling(const NoReading& /*nothing*/, const Flavour& /*flavour*/) const {
    return probability;
  }
  friend bool operator==(const FixedProbability&, const FixedProbability&) = default;
};

}  // namespace swarmsmith
