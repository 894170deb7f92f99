#include "sim/control/labeler.h"

#include <algorithm>

namespace swarmsmith {

Rgb nearest_label(Rgb reading, std::span<const Rgb> labels) {
  const auto distance2 = [reading](Rgb label) {  // eq. 3.2
    const int r = reading.r - label.r;
    const int g = reading.g - label.g;
    const int b = reading.b - label.b;
    return r * r + g * g + b * b;
  };
  const auto nearest = std::min_element(  // eq. 3.1; the first one in a tie
      labels.begin(), labels.end(), [&](Rgb a, Rgb b) { return distance2(a) < distance2(b); });
  return nearest == labels.end() ? reading : *nearest;
}

}  // namespace swarmsmith
