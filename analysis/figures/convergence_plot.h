#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// How good the best machine of a design was, by the experiments that had been used.
struct ConvergencePlot {
  struct Point {
    double experiments = 0;
    double mean = 0;
  };
  struct Line {
    std::string name;  ///< "d3"
    std::size_t color = 0;
    std::vector<Point> points;  ///< one an iteration
  };

  std::string title;
  std::vector<std::string> details;
  std::vector<std::string> groups;  ///< what each colour stands for: a method, or one design
  std::vector<Line> lines;
  double width_mm = 84;
};

/// As SVG. A line holds its value until the iteration that changed it has ended.
std::string draw(const ConvergencePlot& plot);

}  // namespace swarmsmith
