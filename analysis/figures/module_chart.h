#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// How often winners have each module: a table with bars, with a row per module and a column per
/// mission; the columns of different methods are below each other.
struct ModuleChart {
  struct Column {
    std::string mission;
    std::size_t designs = 0;
    std::vector<std::optional<ModuleCounts>> cells;  ///< one per module; empty: a dash
  };
  struct Block {
    std::string method;
    std::vector<Column> columns;
  };

  std::string title;
  std::vector<std::string> details;
  std::vector<std::string> modules;
  std::vector<Block> blocks;
  double width_mm = 84;
  bool explained = true;  ///< adds an explanation below the chart
};

/// The chart as SVG. Columns that do not fit side by side continue below; if the chart is then
/// higher than a page, it becomes a grid of methods for each mission.
std::string draw(const ModuleChart& chart);

}  // namespace swarmsmith
