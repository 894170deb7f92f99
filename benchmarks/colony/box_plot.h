#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// One box and its points.
struct BoxedSample {
  std::string label;  ///< below the box
  std::string group;  ///< below all boxes of the group; neighbours of one name are one group
  std::size_t color = 0;
  std::vector<double> values;
};

/// Boxes from the lower to the upper quartile with the median, whiskers to the ends, and all
/// points; larger values are higher. Returns an SVG of that title, with `axis` at the values.
std::string box_plot(const std::vector<BoxedSample>& samples, const std::string& title,
                     const std::string& axis);

}  // namespace swarmsmith
