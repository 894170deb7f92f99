#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace swarmsmith {

/// Which values a design sampled, iteration by iteration: a small panel a parameter.
struct SamplingPlot {
  /// The candidates sampled in an iteration.
  struct Column {
    std::int64_t candidates = 0;
    std::vector<std::int64_t> counts;  ///< a category, or an equal part of the range, from below
    std::vector<double> elites;        ///< values of the elites at the iteration's end
  };
  struct Panel {
    std::string name;
    std::vector<std::string> categories;  ///< empty for numbers
    double low = 0;                       ///< range of numbers
    double high = 1;
    bool is_whole = false;        ///< a part is one whole number, in the middle of its part
    std::vector<Column> columns;  ///< one an iteration of `iterations`
  };

  std::string title;
  std::vector<std::string> details;
  std::string caption;  ///< below the figure: by which rule these parameters were chosen
  std::vector<std::int64_t> iterations;
  std::vector<Panel> panels;
  std::size_t panels_a_line = 3;
  double width_mm = 84;
};

/// As SVG. Categories as shares of an iteration's candidates, stacked (the rest is not active);
/// numbers as shades by how densely they were sampled, with the elites' values.
std::string draw(const SamplingPlot& plot);

}  // namespace swarmsmith
