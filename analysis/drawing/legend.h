#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// One entry of the legend below a figure.
struct LegendEntry {
  std::string color;  ///< of its swatch; empty: no swatch
  std::string text;
};

/// A legend in columns of equal width, with as many columns as fit.
class Legend {
 public:
  Legend(std::vector<LegendEntry> entries, double width);

  double height() const;
  void draw(Svg& svg, double top) const;

 private:
  std::vector<LegendEntry> entries_;
  double column_width_ = 0;
  std::size_t columns_ = 1;
};

/// A legend with entries one after the other, each as wide as its text, on as many lines as needed.
class FlowingLegend {
 public:
  FlowingLegend(std::vector<LegendEntry> entries, double width);

  double height() const;
  void draw(Svg& svg, double top) const;

 private:
  std::vector<LegendEntry> entries_;
  std::vector<PagePoint> places_;  ///< of each entry, from the legend's upper left corner
};

}  // namespace swarmsmith
