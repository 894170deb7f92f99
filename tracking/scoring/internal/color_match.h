#pragma once

#include <array>
#include <span>

#include "sim/mission/arena.h"

namespace swarmsmith {

/// Which of some colours a measured one is.
struct ColorMatch {
  Rgb best;
  Rgb second;
  double distance = 0;    ///< to the best; neighbours among the labeler's colours are 1 apart
  double confidence = 0;  ///< 1 - distance / distance to the second
};

/// `ratio`: red, green and blue over those of the floor, which is of the colour `floor`. Colours
/// are compared by hue: paints and prints are less saturated and darker than the colours of a
/// mission. Where there is no hue, by lightness. `colors`: two or more.
ColorMatch nearest_color(const std::array<double, 3>& ratio, std::span<const Rgb> colors,
                         Rgb floor);

}  // namespace swarmsmith
