#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Points for pairs of values with the same unit, in panels side by side. Both axes of a panel have
/// the same range, and a dashed line shows where the two values are equal.
struct ScatterPlot {
  struct Point {
    double x = 0;
    double y = 0;
    std::size_t color = 0;
  };
  struct Panel {
    std::string title;
    std::vector<Point> points;  ///< at least one
  };
  std::string title;
  std::vector<std::string> details;
  std::string horizontal;
  std::string vertical;
  std::vector<Panel> panels;
  std::vector<std::pair<std::size_t, std::string>> groups;  ///< the meaning of the colours
  double width_mm = 84;
};

/// The plot as SVG.
std::string draw(const ScatterPlot& plot);

}  // namespace swarmsmith
