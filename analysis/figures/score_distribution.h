#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// How often each score occurred: bars of groups side by side, a panel a mission.
struct ScoreDistribution {
  std::string title;
  std::vector<std::string> details;
  /// At most kDistinctColors groups, each with its own colour; a figure of more is a grid.
  std::vector<ScorePanel> panels;
  std::vector<std::string> groups;  ///< what each colour stands for; empty for nothing here
  double width_mm = 84;
};

/// Values that are counted together: from `low` in steps of `width`, each with its low end.
struct ScoreBins {
  double low = 0;
  double width = 1;
  std::size_t count = 1;
  bool single = false;  ///< each holds one whole number

  std::size_t bin_of(double value) const;
};

/// A bin for each whole number where all values are, and lie within kMostSingleBins; else round
/// bins, about as many as Sturges (1926) has for so many values.
ScoreBins score_bins(const std::vector<double>& values);
inline constexpr std::size_t kMostSingleBins = 16;

/// As SVG. A bar's height is the share of its group's scores, so that groups of different sizes
/// compare; its number is how many these are.
std::string draw(const ScoreDistribution& plot);

}  // namespace swarmsmith
