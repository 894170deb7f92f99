#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "analysis/drawing/axes.h"
#include "analysis/figures/internal/category_colors.h"
#include "analysis/figures/sampling_plot.h"

namespace swarmsmith {

/// The height of a line of a panel's name, mm.
inline constexpr double kPanelNameLine = 3.2;

/// The density from which each shade is used; 1 is an even spread over the range.
inline constexpr std::array<double, 4> kDensities = {0, 1, 2, 4};
std::string density_color(std::size_t shade);

/// The smallest and the largest number of a panel, as texts.
std::array<std::string, 2> end_texts(const SamplingPlot::Panel& panel);

/// Draws one panel within its area; the numbers at the ends of its axis are left of the area.
class SamplingPanel {
 public:
  SamplingPanel(Svg& svg, const SamplingPlot::Panel& panel, const PlotArea& area);

  /// Draws the shares of categories, stacked.
  void shares(const CategoryColors& colors);
  /// Draws the densities of numbers as shades, and the elites' values.
  void densities();
  /// Draws the frame and the panel's name, whose baseline begins at `name`, at most `width` wide.
  void frame(PagePoint name, double width);

 private:
  void elites();
  void ends(const std::string& low, const std::string& high);

  Svg& svg_;
  const SamplingPlot::Panel& panel_;
  PlotArea area_;
  Bands bands_;
  double thickness_ = 0;
};

}  // namespace swarmsmith
