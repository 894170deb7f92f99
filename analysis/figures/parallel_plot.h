#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// Parallel coordinates: one axis per parameter, one line per candidate. The axes are horizontal,
/// one below the other, so that names and categories can be read; the last axis is the mean score.
struct ParallelPlot {
  struct Parameter {
    std::string name;
    std::vector<std::string> categories;  ///< empty for numbers
    double low = 0;                       ///< smallest number
    double high = 1;
  };
  struct Line {
    std::string name;  ///< "c812"
    bool is_elite = false;
    double mean = 0;  ///< mean score
    std::vector<double>
        values;  ///< one per parameter: index of its category, or number; NaN: inactive
  };

  std::string title;
  std::vector<std::string> details;
  std::string caption;  ///< below the figure: how parameters and lines were selected
  std::vector<Parameter> parameters;
  std::vector<Line> lines;
  double width_mm = 84;
};

/// The plot as SVG. Elites are bold and on top, other candidates are pale; colours show the mean
/// score. Inactive parameters have a separate place before each axis.
std::string draw(const ParallelPlot& plot);

}  // namespace swarmsmith
