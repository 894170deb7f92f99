#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swarmsmith {

/// The score of a design's best machine over the number of used experiments. Each mission has its
/// own panel, because scores of different missions cannot be compared.
struct ConvergencePlot {
  struct Point {
    double experiments = 0;
    double mean = 0;         ///< score of the best machine
    double least_elite = 0;  ///< the smallest and the largest mean among the elites
    double largest_elite = 0;
  };
  struct Line {
    std::string name;  ///< "d3"
    std::size_t group = 0;
    std::vector<Point> points;  ///< one per iteration
  };
  struct Panel {
    std::string name;  ///< of the mission
    std::vector<Line> lines;
  };

  std::string title;
  std::vector<std::string> details;
  /// The meaning of each colour: a method, or one design. Groups without a line are not in the
  /// legend.
  std::vector<std::string> groups;
  std::vector<Panel> panels;
  double width_mm = 84;
};

/// The plot as SVG. A line keeps its value until the end of the iteration that changed it. If a
/// figure has only one line, it also shows the band of its elites; if a group has five or more
/// lines, they are pale, and their median is bold.
std::string draw(const ConvergencePlot& plot);

}  // namespace swarmsmith
