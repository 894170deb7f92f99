#pragma once

#include <string>
#include <vector>

#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Box plots with all their points, a panel beside the other.
struct BoxPlot {
  std::string title;
  std::vector<std::string> details;
  std::string axis = "score (higher is better)";
  std::vector<ScorePanel> panels;  ///< no group is empty
  std::string legend{};            ///< what tells boxes of one name apart; stands in papers, too
  double width_mm = 84;
  bool explained = true;  ///< says below how to read it
};

/// What a box shows: quartiles (R's type 7), and how far the whiskers go: to the last values within
/// 1.5 times the quartiles' distance from them (Tukey 1977).
struct BoxNumbers {
  double lower_whisker = 0;
  double lower_quartile = 0;
  double median = 0;
  double upper_quartile = 0;
  double upper_whisker = 0;
  double mean = 0;
};

/// Of values in any order, not none.
BoxNumbers box_numbers(std::vector<double> values);

/// As SVG. Boxes stand side by side; where their names would be cut, or the page is too low or too
/// wide for that, they lie below each other. Every value is a point; points stand side by side in
/// an order that depends on the values alone. Where values repeat, their counts are written beside
/// them, if there is room.
std::string draw(const BoxPlot& plot);

}  // namespace swarmsmith
