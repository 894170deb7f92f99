#pragma once

#include <string_view>

#include "sim/control/module_parts.h"
#include "sim/control/readings.h"

namespace swarmsmith {

/// True when the grey level of the floor is high.
struct WhiteFloor {
  static constexpr std::string_view kId = "white_floor";
  static constexpr std::string_view kLabel = "White floor";
  using Reads = FloorReading;

  double probability = 0;  ///< beta, in [0, 1]

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(beta_parameter(), self.probability);
  }
  double enabling(const FloorReading& floor, const Flavour& flavour) const {
    return flavour.floor.sees(flavour.floor.white, floor.color) ? probability : 0.0;
  }
  friend bool operator==(const WhiteFloor&, const WhiteFloor&) = default;
};

}  // namespace swarmsmith
