#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Points of pairs of values that have one unit, a panel beside the other. Both axes of a panel
/// have the same range, and a dashed line says where both values are the same.
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
  std::vector<std::pair<std::size_t, std::string>> groups;  ///< what the colours stand for
  double width_mm = 84;
};

/// As SVG.
std::string draw(const ScatterPlot& plot);

}  // namespace swarmsmith
