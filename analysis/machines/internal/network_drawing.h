#pragma once

#include <string>
#include <string_view>

#include "analysis/machines/internal/sketch.h"

namespace swarmsmith {

struct Network;

/// A table of the weights, a row an input and a column a wheel, each cell in the colour of its
/// weight, and the scale of colours beside it. The scale is symmetric about 0 and reaches to 5, or
/// to the next round number above the largest weight.
///
/// Throws std::invalid_argument when the page is narrower than `kNarrowestMachine_mm`.
Sketch sketch_of(const Network& network, double width_mm);

/// Inputs and wheels are nodes; edges have their weights as labels and in their widths.
std::string dot_of(const Network& network, std::string_view title);

}  // namespace swarmsmith
