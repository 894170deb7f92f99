#include "analysis/figures/scatter_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/figure.h"
#include "analysis/figures/internal/panel_grid.h"

namespace swarmsmith {
namespace {

constexpr double kLeastPanel = 48;  ///< mm
constexpr double kLargest = 60;
constexpr double kSmallest = 30;
constexpr double kRadius = 0.8;

ValueRange range_of(const ScatterPlot::Panel& panel) {
  std::vector<double> all;
  for (const auto& point : panel.points) {
    all.push_back(point.x);
    all.push_back(point.y);
  }
  return rounded(range_over(all), kUsualTicks);
}

/// The width of the vertical axis's labels; the same in all panels, so that they are aligned.
double room_of(const ScatterPlot& plot) {
  double room = 0;
  for (const ScatterPlot::Panel& panel : plot.panels)
    room = std::max(room, tick_room(range_of(panel), kUsualTicks));
  return room;
}

/// The side of a panel's square: as wide as possible, but small enough that all rows fit on a page
/// if they remain readable. `other`: height of the rest of the figure.
double side_of(double width, std::size_t rows, double other) {
  constexpr double kHalfOfTheLastTick = 4;
  const double fits = (kFigurePage_mm - other) / static_cast<double>(rows);
  return std::min({width - kHalfOfTheLastTick, kLargest, std::max(fits, kSmallest)});
}

void draw_panel(Svg& svg, const ScatterPlot& plot, const ScatterPlot::Panel& panel,
                const PlotArea& area) {
  const ValueRange range = range_of(panel);
  const Axis x(range, area.left, area.right());
  const Axis y(range, area.bottom(), area.top);
  draw_vertical_axis(svg, area, y, "");
  draw_horizontal_axis(svg, area, x, plot.horizontal);
  const std::vector<PagePoint> same = {{area.left, area.bottom()}, {area.right(), area.top}};
  Paint dashed = stroked(kInk, 0.2);
  dashed.dashes = "1 0.8";
  svg.line(same, dashed);
  for (const auto& point : panel.points)
    svg.circle({x.at(point.x), y.at(point.y)}, kRadius, filled(distinct_color(point.color)));
}

}  // namespace

std::string draw(const ScatterPlot& plot) {
  const PanelGrid grid(plot.panels.size(), kLeastPanel, plot.width_mm);
  const double heading = kMargin + (plot.title.empty() ? 0 : kTitleSize) +
                         kLineHeight * static_cast<double>(plot.details.size()) + 2;
  std::vector<LegendEntry> entries;
  if (plot.groups.size() > 1) {
    for (const auto& [color, name] : plot.groups)
      entries.push_back({distinct_color(color), name});
  }
  const FlowingLegend legend(entries, plot.width_mm - 2 * kMargin);
  constexpr double kBelow = kHorizontalAxisRoom + 2;
  const double room = room_of(plot);
  const double side = side_of(grid.width() - room, grid.rows(),
                              heading + kLineHeight + legend.height() + kMargin +
                                  (kPanelTitleRoom + kBelow) * static_cast<double>(grid.rows()));
  std::vector<PlotArea> areas;
  double bottom = heading + kLineHeight;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    double lowest = bottom;
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
      if (grid.row_of(i) != row) continue;
      areas.push_back({.left = grid.left_of(i) + room,
                       .top = bottom + kPanelTitleRoom,
                       .width = side,
                       .height = side});
      lowest = std::max(lowest, areas.back().bottom());
    }
    bottom = lowest + kBelow;
  }
  Svg svg(plot.width_mm, bottom + legend.height() + kMargin, plot.title,
          fmt::format("{} over {}", plot.vertical, plot.horizontal));
  const double top = draw_heading(svg, plot.title, plot.details);
  svg.text({kMargin, top + kTextSize}, fitted_text(plot.vertical, kTextSize, plot.width_mm - 4),
           {.size = kTextSize, .fill = std::string(kInk)});
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    draw_panel_title(svg, plot.panels[i].title, grid.left_of(i), areas[i].top, grid.width());
    draw_panel(svg, plot, plot.panels[i], areas[i]);
  }
  if (!entries.empty()) legend.draw(svg, bottom);
  return svg.finish();
}

}  // namespace swarmsmith
