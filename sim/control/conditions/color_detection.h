#pragma once

#include <string_view>

#include "sim/control/module_parts.h"
#include "sim/control/readings.h"

namespace swarmsmith {

/// True when the colour of the floor is perceived as the label.
struct ColorDetection {
  static constexpr std::string_view kId = "color_detection";
  static constexpr std::string_view kLabel = "Color detection";
  using Reads = FloorReading;

  double probability = 0;  ///< beta, in [0, 1]
  ColorLabel label = ColorLabel::Green;

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(beta_parameter(), self.probability);
    visitor(ParameterSpec{.name = "label",
                          .symbol = "L",
                          .token = "l",
                          .type = ParameterSpec::Type::Label,
                          .low = 0,
                          .high = 3,
                          .digits = 0,
                          .least = 0,
                          .most = 3},
            self.label);
  }
  double enabling(const FloorReading& floor, const Flavour& flavour) const {
    return perceived_label(floor.color, flavour.floor) == label ? probability : 0.0;
  }
  friend bool operator==(const ColorDetection&, const ColorDetection&) = default;
};

}  // namespace swarmsmith
