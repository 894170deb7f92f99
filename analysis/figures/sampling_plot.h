#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace swarmsmith {

/// The values that a design sampled, iteration by iteration: one small panel per parameter.
struct SamplingPlot {
  /// The candidates sampled in an iteration.
  struct Column {
    std::int64_t candidates = 0;
    std::vector<std::int64_t>
        counts;                  ///< one per category, or per equal part of the range, lowest first
    std::vector<double> elites;  ///< values of the elites at the iteration's end
  };
  struct Panel {
    std::string name;
    std::vector<std::string> categories;  ///< empty for numbers
    double low = 0;                       ///< smallest number
    double high = 1;
    bool is_whole = false;        ///< each part is one whole number, at the middle of the part
    std::vector<Column> columns;  ///< one for each of `iterations`
  };

  std::string title;
  std::vector<std::string> details;
  std::string caption;  ///< below the figure: how these parameters were selected
  std::vector<std::int64_t> iterations;
  std::vector<Panel> panels;
  std::size_t panels_a_line = 3;
  double width_mm = 84;
};

/// The plot as SVG. Categories: stacked shares of an iteration's candidates (the rest is inactive).
/// Numbers: shades that show how densely they were sampled, with the elites' values.
std::string draw(const SamplingPlot& plot);

}  // namespace swarmsmith
