#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Mean ranks of methods or sources with the intervals from the test.
struct RankPlot {
  struct Row {
    std::string name;
    double mean = 1;  ///< 1 is best
    /// Its interval; empty if the test finds no differences.
    std::optional<std::pair<double, double>> interval{};
  };
  struct Panel {
    std::string title;                 ///< may be empty
    std::vector<std::string> details;  ///< a description of the test, below the title
    std::vector<Row> rows;
  };

  std::string title;
  std::vector<Panel> panels;
  double width_mm = 84;
  std::string reading;    ///< below: the meaning of the intervals in all panels
  bool explained = true;  ///< shows `reading`
};

/// The plot as SVG, best rows on top. A band shows the interval of the best row, if it has one.
std::string draw(const RankPlot& plot);

}  // namespace swarmsmith
