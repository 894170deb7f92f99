#pragma once

#include <string>
#include <vector>

#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Box plots with all their points, in panels side by side.
struct BoxPlot {
  std::string title;
  std::vector<std::string> details;
  std::string axis = "score (higher is better)";
  std::vector<ScorePanel> panels;  ///< no group may be empty
  std::string legend{};            ///< explains boxes of the same name; also shown in papers
  double width_mm = 84;
  bool explained = true;  ///< adds an explanation below the plot
};

/// The numbers of a box: quartiles (R's type 7), and the ends of the whiskers, which are the last
/// values within 1.5 times the interquartile range from the quartiles (Tukey 1977).
struct BoxNumbers {
  double lower_whisker = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double upper_whisker = 0;
  double mean = 0;
};

/// For values in any order; there must be at least one.
BoxNumbers box_numbers(std::vector<double> values);

/// The plot as SVG. Boxes stand side by side; if their names would be shortened, or if the page is
/// too low or too wide for that, the boxes are horizontal, one below the other. Every value is a
/// point. Points are spread in an order that depends only on the values. For repeated values, their
/// counts are written beside them if there is room.
std::string draw(const BoxPlot& plot);

}  // namespace swarmsmith
