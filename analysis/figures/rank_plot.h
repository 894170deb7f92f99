#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Mean ranks of methods or sources with the intervals that the test allows.
struct RankPlot {
  struct Row {
    std::string name;
    double mean = 1;  ///< 1 is best
    /// Its interval; none where the test tells no two apart.
    std::optional<std::pair<double, double>> interval{};
  };
  struct Panel {
    std::string title;                 ///< empty for none
    std::vector<std::string> details;  ///< the test, below the title
    std::vector<Row> rows;
  };

  std::string title;
  std::vector<Panel> panels;
  double width_mm = 84;
  std::string reading;    ///< below: what the intervals of all panels say
  bool explained = true;  ///< shows it
};

/// As SVG, best rows on top. A band shows the best one's interval, if it has one.
std::string draw(const RankPlot& plot);

}  // namespace swarmsmith
