#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// Mean ranks of methods or sources with intervals whose overlap says "not significant".
struct RankPlot {
  struct Row {
    std::string name;
    double mean = 1;  ///< 1 is best
    double low = 1;   ///< ends of its interval
    double high = 1;
  };
  struct Panel {
    std::string title;                 ///< empty for none
    std::vector<std::string> details;  ///< the test, below the title
    std::vector<Row> rows;
  };

  std::string title;
  std::vector<Panel> panels;
  double width_mm = 84;
  bool explained = true;  ///< says below how to read it
};

/// As SVG, best rows on top. A band shows the best one's interval.
std::string draw(const RankPlot& plot);

}  // namespace swarmsmith
