#pragma once

#include <string>

#include "analysis/figures/module_chart.h"

namespace swarmsmith {

/// The chart of many methods on one page: a grid a mission with rows of modules and columns of
/// methods, a number and a shade a cell.
std::string draw_module_grid(const ModuleChart& chart);

}  // namespace swarmsmith
