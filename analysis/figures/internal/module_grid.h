#pragma once

#include <string>

#include "analysis/figures/module_chart.h"

namespace swarmsmith {

/// A chart of many methods on one page: one grid per mission, with a row per module and a column
/// per method; each cell has a number and a shade.
std::string draw_module_grid(const ModuleChart& chart);

}  // namespace swarmsmith
