#pragma once

#include <string_view>

#include "sim/control/module_parts.h"
#include "sim/control/readings.h"

namespace swarmsmith {

/// True when the grey level of the floor is in the middle range.
struct GrayFloor {
  static constexpr std::string_view kId = "gray_floor";
  static constexpr std::string_view kLabel = "Gray floor";
  using Reads = FloorReading;

  double probability = 0;  ///< beta, in [0, 1]

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(beta_parameter(), self.probability);
  }
  double enabling(const FloorReading& floor, const Flavour& flavour) const {
    return flavour.floor.sees(flavour.floor.gray, floor.color) ? probability : 0.0;
  }
  friend bool operator==(const GrayFloor&, const GrayFloor&) = default;
};

}  // namespace swarmsmith
