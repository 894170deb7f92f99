#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swarmsmith {

/// How good the best machine of a design was, by the experiments that had been used. Scores of
/// different missions mean different things, so that each mission has a panel of its own.
struct ConvergencePlot {
  struct Point {
    double experiments = 0;
    double mean = 0;         ///< of the best machine
    double least_elite = 0;  ///< the least and the largest mean of the elites
    double largest_elite = 0;
  };
  struct Line {
    std::string name;  ///< "d3"
    std::size_t group = 0;
    std::vector<Point> points;  ///< one an iteration
  };
  struct Panel {
    std::string name;  ///< of the mission
    std::vector<Line> lines;
  };

  std::string title;
  std::vector<std::string> details;
  /// What each colour stands for: a method, or one design; those without a line are not told.
  std::vector<std::string> groups;
  std::vector<Panel> panels;
  double width_mm = 84;
};

/// As SVG. A line holds its value until the iteration that changed it has ended. A line alone in
/// its figure has the band of its elites; from five lines of a group on they are pale, and their
/// median is bold.
std::string draw(const ConvergencePlot& plot);

}  // namespace swarmsmith
