#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// How often winners have each module: a table with bars, rows of modules and columns of missions,
/// the columns of a method below those of the other.
struct ModuleChart {
  struct Column {
    std::string mission;
    std::size_t designs = 0;
    std::vector<std::optional<ModuleCounts>> cells;  ///< one a module; none: a dash
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
  bool explained = true;  ///< says below how to read it
};

/// As SVG. Columns that do not fit side by side continue below; what then is higher than a page is
/// drawn as a grid of methods a mission.
std::string draw(const ModuleChart& chart);

}  // namespace swarmsmith
