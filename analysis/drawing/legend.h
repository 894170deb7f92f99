#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// One entry below a figure.
struct LegendEntry {
  std::string color;  ///< of its swatch; empty for none
  std::string text;
};

/// Entries in equal columns, as many as fit side by side.
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

/// Entries one after the other, each as wide as it is, on as many lines as they need.
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
