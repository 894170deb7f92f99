#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Histograms of scores: the bars of the groups are side by side, one panel per mission.
struct ScoreDistribution {
  std::string title;
  std::vector<std::string> details;
  /// At most kDistinctColors groups, each with its own colour; with more groups, the figure is a
  /// grid.
  std::vector<ScorePanel> panels;
  std::vector<std::string> groups;  ///< the meaning of each colour; empty if a colour is not used
  double width_mm = 84;
};

/// Bins of values: the first starts at `low`, each is `width` wide, and each includes its lower
/// end.
struct ScoreBins {
  double low = 0;
  double width = 1;
  std::size_t count = 1;
  bool single = false;  ///< each bin is one whole number

  std::size_t bin_of(double value) const;
};

/// One bin per whole number if all values are whole and lie within kMostSingleBins numbers; else
/// round bins, about as many as Sturges' rule (1926) gives for this number of values.
ScoreBins score_bins(const std::vector<double>& values);
inline constexpr std::size_t kMostSingleBins = 16;

/// The plot as SVG. The height of a bar is its share of the group's scores, so that groups of
/// different sizes can be compared; the number above it is the count.
std::string draw(const ScoreDistribution& plot);

}  // namespace swarmsmith
