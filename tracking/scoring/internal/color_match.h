#pragma once

#include <array>
#include <span>

#include "sim/mission/arena.h"

namespace swarmsmith {

/// The colour, out of a given set, that a measured colour matches best.
struct ColorMatch {
  Rgb best;
  Rgb second;
  double distance = 0;    ///< to the best colour; neighbouring colours of the labeler are 1 apart
  double confidence = 0;  ///< 1 - distance / distance to the second best
};

/// `ratio` is red, green and blue divided by the values of the floor, whose colour is `floor`.
/// Colours are compared by hue, because paints and prints are less saturated and darker than the
/// colours of a mission; colours without a hue are compared by lightness. `colors` has at least two
/// entries.
ColorMatch nearest_color(const std::array<double, 3>& ratio, std::span<const Rgb> colors,
                         Rgb floor);

}  // namespace swarmsmith
