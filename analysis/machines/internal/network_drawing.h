#pragma once

#include <string>
#include <string_view>

#include "analysis/machines/internal/sketch.h"

namespace swarmsmith {

struct Network;

/// A table of the weights with one row per input and one column per wheel, each cell in the colour
/// of its weight, and the colour scale beside it. The scale is symmetric about 0; it ends at 5, or
/// at the next round number above the largest weight.
///
/// Throws std::invalid_argument if the page is narrower than `kNarrowestMachine_mm`.
Sketch sketch_of(const Network& network, double width_mm);

/// The network as a graph: inputs and wheels are nodes; the label and width of an edge show its
/// weight.
std::string dot_of(const Network& network, std::string_view title);

}  // namespace swarmsmith
