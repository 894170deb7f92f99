#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// Parallel coordinates: an axis a parameter, a line a candidate. The axes lie one below the other
/// so that names and categories stand upright; the last one is the mean score.
struct ParallelPlot {
  struct Parameter {
    std::string name;
    std::vector<std::string> categories;  ///< empty for numbers
    double low = 0;                       ///< range of numbers
    double high = 1;
  };
  struct Line {
    std::string name;  ///< "c812"
    bool is_elite = false;
    double mean = 0;             ///< score
    std::vector<double> values;  ///< a parameter: place of its category, or number; NaN: not active
  };

  std::string title;
  std::vector<std::string> details;
  std::string caption;  ///< below the figure: by which rules parameters and lines were chosen
  std::vector<Parameter> parameters;
  std::vector<Line> lines;
  double width_mm = 84;
};

/// As SVG. Elites are bold and on top, the others pale; colours are by mean score. What is not
/// active has a place of its own before each axis.
std::string draw(const ParallelPlot& plot);

}  // namespace swarmsmith
