#include "analysis/figures/box_plot.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/box_marks.h"
#include "analysis/figures/internal/box_rows.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/panel_grid.h"
#include "analysis/figures/internal/score_groups.h"
#include "analysis/figures/makers.h"
#include "analysis/statistics/summary.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kLeastBand = 9;     ///< for a box with space on both sides, mm
constexpr double kPairedBand = 5;    ///< for a box of a pair: half the width
constexpr double kNarrow = 0.5;      ///< width of a narrow box relative to a wide one
constexpr double kMostBand = 24;     ///< boxes further apart are hard to compare
constexpr double kLongestName = 19;  ///< longer words are shortened
constexpr double kAboveLine = 1.5;   ///< distance of the lowest values from the line
constexpr double kRatio = 0.62;      ///< height of the area relative to its width, within limits
constexpr double kPage = 240;        ///< height of a journal's page
constexpr std::string_view kExplanation =
    "Box: quartiles; line: median; diamond: mean; whiskers: last values within 1.5 box heights; "
    "n: values, each a point";
constexpr std::string_view kLyingExplanation =
    "Box: quartiles; line: median; diamond: mean; whiskers: last values within 1.5 box lengths; "
    "n: values, each a point";

/// The width of the counts at the right of a box. The same width is left free on its left side, so
/// that the box stays above its name. 0 if there are no counts.
double counts_beside(const ScorePanel& panel) {
  double room = 0;
  for (const ScoreGroup& group : panel.groups)
    room = std::max(room, count_room(group.values));
  return room;
}

/// The minimum width of each group of a panel.
double least_band(const ScorePanel& panel) {
  double least = (has_pairs(panel) ? kPairedBand : kLeastBand) + 2 * counts_beside(panel);
  for (const std::string& name : names_of(panel)) {
    for (const std::string& word : broken_text(name, kTextSize, 1000, 1000))
      least = std::max(least, std::min(text_width(word, kTextSize) + 1, kLongestName) /
                                  (has_pairs(panel) ? 2 : 1));
  }
  return least;
}

double least_width(const ScorePanel& panel) {
  return tick_room(range_of(panel), kUsualTicks) +
         least_band(panel) * static_cast<double>(panel.groups.size());
}

/// The width of the tick labels; the same in all panels, so that areas below each other are
/// aligned.
double ticks_beside(const BoxPlot& plot) {
  double room = 0;
  for (const ScorePanel& panel : plot.panels)
    room = std::max(room, tick_room(range_of(panel), kUsualTicks));
  return room;
}

/// The panel's data area within its place in the grid. Groups stay close together instead of
/// filling the place.
PlotArea area_of(const ScorePanel& panel, double left, double top, double width, double ticks) {
  PlotArea area{.left = left + ticks, .top = top};
  area.width =
      std::min(left + width - area.left, kMostBand * static_cast<double>(panel.groups.size()));
  return area;
}

Bands bands_of(const ScorePanel& panel, const PlotArea& area) {
  return {panel.groups.size(), area.left, area.right()};
}

/// One band per name.
Bands name_bands_of(const ScorePanel& panel, const PlotArea& area) {
  return {names_of(panel).size(), area.left, area.right()};
}

void draw_panel(Svg& svg, const ScorePanel& panel, const PlotArea& area) {
  const TextStyle middle{
      .size = kTextSize, .anchor = TextStyle::Anchor::Middle, .fill = std::string(kInk)};
  // Keeps the lowest values away from the line below them.
  const Axis y(range_of(panel), area.bottom() - kAboveLine, area.top);
  draw_vertical_axis(svg, area, y, "");
  const Bands bands = bands_of(panel, area);
  const double counts = counts_beside(panel);
  const double half = std::clamp((bands.width() / 2 - counts - 0.5) * 0.8, 0.8, 4.0);
  std::vector<BoxPlace> places;
  for (std::size_t i = 0; i < panel.groups.size(); ++i)
    places.push_back({.middle = bands.centre(i),
                      .half = panel.groups[i].narrow ? kNarrow * half : half,
                      .end = bands.centre(i) + bands.width() / 2});
  draw_marks(svg, panel, places, y);
  const Bands names = name_bands_of(panel, area);
  draw_band_axis(svg, area, names, names_of(panel));
  const double below = area.bottom() + band_axis_room(names, names_of(panel)) + kTextSize;
  svg.text({area.left - 1, below}, "n",
           {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
  for (std::size_t i = 0; i < panel.groups.size(); ++i)
    svg.text({bands.centre(i), below}, fmt::format("{}", panel.groups[i].values.size()), middle);
}

/// The layout: one area per panel, and the lower end of the last row.
struct BoxLayout {
  std::vector<PlotArea> areas;
  double bottom = 0;
};

BoxLayout layout_of(const BoxPlot& plot, const PanelGrid& grid, double top) {
  BoxLayout layout{.bottom = top};
  const double ticks = grid.rows() > 1 ? ticks_beside(plot) : 0;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    const double height = std::clamp(kRatio * grid.width(), 36.0, 60.0);
    double below = 0;
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
      if (grid.row_of(i) != row) continue;
      const ScorePanel& panel = plot.panels[i];
      PlotArea area = area_of(panel, grid.left_of(i), layout.bottom + kPanelTitleRoom, grid.width(),
                              std::max(ticks, tick_room(range_of(panel), kUsualTicks)));
      area.height = height;
      below = std::max(below, band_axis_room(name_bands_of(panel, area), names_of(panel)));
      layout.areas.push_back(area);
    }
    layout.bottom += kPanelTitleRoom + height + below + kLineHeight + 2;
  }
  return layout;
}

/// Whether the boxes can stand side by side above their names: they fit on the page, no name is
/// shortened, and they do not look lost in a wide figure.
bool can_stand(const BoxPlot& plot, const PanelGrid& grid, const BoxLayout& layout) {
  constexpr double kWide = 120;
  constexpr double kFilled = 0.75;
  bool is_filled = plot.width_mm < kWide;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const PlotArea& area = layout.areas[i];
    if (!band_names_fit(name_bands_of(plot.panels[i], area), names_of(plot.panels[i])))
      return false;
    is_filled = is_filled || area.right() - grid.left_of(i) > kFilled * grid.width();
  }
  return is_filled && layout.bottom <= kPage;
}

}  // namespace

BoxNumbers box_numbers(std::vector<double> values) {
  std::ranges::sort(values);
  BoxNumbers box{.lower_quartile = quantile_of(values, 0.25),
                 .median = quantile_of(values, 0.5),
                 .upper_quartile = quantile_of(values, 0.75)};
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  box.lower_whisker = *std::ranges::lower_bound(values, box.lower_quartile - reach);
  box.upper_whisker = *std::prev(std::ranges::upper_bound(values, box.upper_quartile + reach));
  // A whisker must not end inside the box.
  box.lower_whisker = std::min(box.lower_whisker, box.lower_quartile);
  box.upper_whisker = std::max(box.upper_whisker, box.upper_quartile);
  box.mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return box;
}

std::string draw(const BoxPlot& plot) {
  double needed = 0;
  for (const ScorePanel& panel : plot.panels)
    needed = std::max(needed, least_width(panel));
  const PanelGrid grid(plot.panels.size(), needed, plot.width_mm);
  const double heading = kMargin + (plot.title.empty() ? 0 : kTitleSize) +
                         kLineHeight * static_cast<double>(plot.details.size()) + 2 + kLineHeight;
  const BoxLayout standing = layout_of(plot, grid, heading);
  const bool stands = can_stand(plot, grid, standing);
  std::vector<std::string> below;
  for (const std::string_view text :
       {std::string_view(plot.legend), !plot.explained ? ""
                                       : stands        ? kExplanation
                                                       : kLyingExplanation}) {
    for (std::string& line : broken_text(text, kTextSize, plot.width_mm - 2 * kMargin, 6))
      below.push_back(std::move(line));
  }
  const double below_height = kLineHeight * static_cast<double>(below.size());
  const BoxRows rows(plot.panels, plot.width_mm, kPage - heading - below_height - kMargin);
  const double bottom = stands ? standing.bottom : heading + rows.height();
  Svg svg(plot.width_mm, bottom + below_height + kMargin, plot.title,
          fmt::format("Box plots with points in {}; {}", counted(plot.panels.size(), "panel"),
                      plot.axis));
  const double top = draw_heading(svg, plot.title, plot.details);
  const TextStyle ink{.size = kTextSize, .fill = std::string(kInk)};
  svg.text({kMargin, top + kTextSize}, fitted_text(plot.axis, kTextSize, plot.width_mm - 4), ink);
  if (!stands) rows.draw(svg, heading);
  for (std::size_t i = 0; stands && i < plot.panels.size(); ++i) {
    draw_panel_title(svg, plot.panels[i].title, grid.left_of(i), standing.areas[i].top,
                     grid.width());
    draw_panel(svg, plot.panels[i], standing.areas[i]);
  }
  for (std::size_t i = 0; i < below.size(); ++i) {
    svg.text({kMargin, bottom + kLineHeight * static_cast<double>(i) + kTextSize}, below[i], ink);
  }
  return svg.finish();
}

Expected<Figure> box_figure(StoreReader& store, const FigureOptions& options) {
  auto scores = grouped_scores(store, options);
  if (!scores) return Unexpected(scores.error());
  std::vector<std::string> details;
  std::string legend;
  if (scores->by == "method") legend = pair_boxes(scores->panels);
  for (const std::string& detail : scores->details) {
    for (std::string& line : broken_text(detail, kTextSize, options.width_mm - 2 * kMargin, 3))
      details.push_back(std::move(line));
  }
  const BoxPlot plot{.title = "Scores by " + scores->by,
                     .details = std::move(details),
                     .panels = std::move(scores->panels),
                     .legend = std::move(legend),
                     .width_mm = options.width_mm};
  return Figure{.svg = draw(for_paper(plot, options)), .csv = std::move(scores->csv), .tex = {}};
}

}  // namespace swarmsmith
