#include "analysis/figures/box_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/panel_grid.h"
#include "analysis/figures/internal/quantile.h"
#include "analysis/figures/internal/score_groups.h"
#include "analysis/figures/makers.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostTicks = 7;
constexpr double kLeastBand = 9;         ///< a box with air on both sides, mm
constexpr double kLeastBandCounts = 13;  ///< and with counts at its right
constexpr double kMostBand = 24;         ///< boxes that are further apart are hard to compare
constexpr double kLongestName = 19;      ///< longer words are cut
constexpr double kAboveLine = 1.5;
constexpr double kCountSize = 2.2;
constexpr double kRatio = 0.62;  ///< height of the area by its width, within limits
constexpr std::size_t kMostCounted = 7;
constexpr std::string_view kExplanation =
    "Box: quartiles; line: median; diamond: mean; whiskers: last values within 1.5 box heights; "
    "n: values, each a point";

/// How often each value occurs, where that is worth writing: some do, and few differ.
std::map<double, std::size_t> repeated(const std::vector<double>& values) {
  std::map<double, std::size_t> counts;
  for (const double value : values)
    ++counts[value];
  if (counts.size() == values.size() || counts.size() > kMostCounted) counts.clear();
  return counts;
}

bool has_counts(const ScorePanel& panel) {
  return std::ranges::any_of(panel.groups,
                             [](const ScoreGroup& g) { return !repeated(g.values).empty(); });
}

ValueRange range_of(const ScorePanel& panel) {
  std::vector<double> all;
  for (const ScoreGroup& group : panel.groups)
    all.insert(all.end(), group.values.begin(), group.values.end());
  return rounded(range_over(all), kMostTicks);
}

std::vector<std::string> names_of(const ScorePanel& panel) {
  std::vector<std::string> names;
  for (const ScoreGroup& group : panel.groups)
    names.push_back(group.name);
  return names;
}

/// The width that each group of a panel needs.
double least_band(const ScorePanel& panel) {
  double least = has_counts(panel) ? kLeastBandCounts : kLeastBand;
  for (const std::string& name : names_of(panel)) {
    for (const std::string& word : broken_text(name, kTextSize, 1000, 1000))
      least = std::max(least, std::min(text_width(word, kTextSize) + 1, kLongestName));
  }
  return least;
}

double least_width(const ScorePanel& panel) {
  return tick_room(range_of(panel), kMostTicks) +
         least_band(panel) * static_cast<double>(panel.groups.size());
}

/// Where a group's box is, and how wide.
struct BoxPlace {
  double x = 0;
  double half = 0;
  double right = 0;  ///< where its band ends
};

void draw_segment(Svg& svg, PagePoint a, PagePoint b, std::string_view color, double width) {
  const std::array<PagePoint, 2> ends = {a, b};
  svg.line(ends, stroked(color, width));
}

void draw_box(Svg& svg, const BoxNumbers& box, const BoxPlace& place, const Axis& y,
              const std::string& color) {
  const auto [x, half, right] = place;
  for (const auto& [from, to] : {std::pair(box.lower_quartile, box.lower_whisker),
                                 std::pair(box.upper_quartile, box.upper_whisker)}) {
    draw_segment(svg, {x, y.at(from)}, {x, y.at(to)}, color, 0.3);
    if (from != to)
      draw_segment(svg, {x - half / 2, y.at(to)}, {x + half / 2, y.at(to)}, color, 0.3);
  }
  const double top = y.at(box.upper_quartile);
  const double bottom = y.at(box.lower_quartile);
  const std::array<PagePoint, 4> corners = {
      {{x - half, top}, {x + half, top}, {x + half, bottom}, {x - half, bottom}}};
  svg.polygon(corners,
              {.fill = lightened(color, 0.75), .stroke = color, .width = 0.3, .dashes = {}});
  draw_segment(svg, {x - half, y.at(box.median)}, {x + half, y.at(box.median)}, kInk, 0.6);
}

void draw_mean(Svg& svg, double mean, const BoxPlace& place, const Axis& y) {
  constexpr double kHalf = 1;
  const double at = y.at(mean);
  const std::array<PagePoint, 4> diamond = {
      {{place.x, at - kHalf}, {place.x + kHalf, at}, {place.x, at + kHalf}, {place.x - kHalf, at}}};
  svg.polygon(diamond,
              {.fill = "#ffffff", .stroke = std::string(kInk), .width = 0.25, .dashes = {}});
}

/// Points of sorted values, spread over the box by steps of the golden ratio: neighbours in value,
/// tied ones above all, come to lie far apart.
void draw_points(Svg& svg, const std::vector<double>& sorted, const BoxPlace& place, const Axis& y,
                 const std::string& color) {
  constexpr double kGolden = 0.6180339887498949;
  const double radius = sorted.size() > 60 ? 0.3 : 0.45;
  std::vector<PagePoint> points;
  double part = 0.5;
  for (const double value : sorted) {
    points.push_back({place.x + (part - 0.5) * 1.6 * place.half, y.at(value)});
    part += kGolden;
    part -= std::floor(part);
  }
  svg.dots(points, radius, color);
}

/// "x12" at the right of each value, unless they are too near to each other to be read.
void draw_counts(Svg& svg, const std::vector<double>& values, const BoxPlace& place,
                 const Axis& y) {
  const auto counts = repeated(values);
  double last = 1e9;
  for (const auto& [value, count] : counts) {
    if (last - y.at(value) < kCountSize * 1.05) return;
    last = y.at(value);
  }
  for (const auto& [value, count] : counts) {
    if (count == 1) continue;
    const std::string text = fmt::format("\u00d7{}", count);
    const double x = place.x + place.half + 0.5;
    if (x + text_width(text, kCountSize) > place.right) continue;
    svg.text({x, y.at(value) + 0.36 * kCountSize}, text,
             {.size = kCountSize, .fill = std::string(kInk)});
  }
}

void draw_group(Svg& svg, const ScoreGroup& group, const BoxPlace& place, const Axis& y) {
  const std::string color = distinct_color(group.color);
  std::vector<double> sorted = group.values;
  std::ranges::sort(sorted);
  const BoxNumbers box = box_numbers(sorted);
  draw_box(svg, box, place, y, color);
  draw_points(svg, sorted, place, y, color);
  draw_mean(svg, box.mean, place, y);
  draw_counts(svg, sorted, place, y);
}

/// The panel's data area within its place in the grid; groups stand together, not spread over it.
PlotArea area_of(const ScorePanel& panel, double left, double top, double width) {
  PlotArea area{.left = left + tick_room(range_of(panel), kMostTicks), .top = top};
  area.width =
      std::min(left + width - area.left, kMostBand * static_cast<double>(panel.groups.size()));
  return area;
}

Bands bands_of(const ScorePanel& panel, const PlotArea& area) {
  return {panel.groups.size(), area.left, area.right()};
}

void draw_panel(Svg& svg, const ScorePanel& panel, const PlotArea& area) {
  const TextStyle middle{
      .size = kTextSize, .anchor = TextStyle::Anchor::Middle, .fill = std::string(kInk)};
  // The lowest values stand clear of the line below them.
  const Axis y(range_of(panel), area.bottom() - kAboveLine, area.top);
  draw_vertical_axis(svg, area, y, "");
  const Bands bands = bands_of(panel, area);
  const double counts = has_counts(panel) ? kCountSize * 0.6 * 3 : 0;
  const double half = std::min(4.0, (bands.width() - counts - 1) / 2 * 0.8);
  for (std::size_t i = 0; i < panel.groups.size(); ++i) {
    const BoxPlace place{.x = bands.centre(i) - counts / 2,
                         .half = half,
                         .right = bands.centre(i) + bands.width() / 2};
    draw_group(svg, panel.groups[i], place, y);
  }
  draw_band_axis(svg, area, bands, names_of(panel));
  const double below = area.bottom() + band_axis_room(bands, names_of(panel)) + kTextSize;
  svg.text({area.left - 1, below}, "n",
           {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
  for (std::size_t i = 0; i < panel.groups.size(); ++i)
    svg.text({bands.centre(i), below}, fmt::format("{}", panel.groups[i].values.size()), middle);
}

/// The places on the page: an area a panel, and where the last row ends.
struct BoxLayout {
  std::vector<PlotArea> areas;
  double bottom = 0;
};

BoxLayout layout_of(const BoxPlot& plot, const PanelGrid& grid, double top) {
  BoxLayout layout{.bottom = top};
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    const double height = std::clamp(kRatio * grid.width(), 36.0, 60.0);
    double below = 0;
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
      if (grid.row_of(i) != row) continue;
      const ScorePanel& panel = plot.panels[i];
      PlotArea area =
          area_of(panel, grid.left_of(i), layout.bottom + kPanelTitleRoom, grid.width());
      area.height = height;
      below = std::max(below, band_axis_room(bands_of(panel, area), names_of(panel)));
      layout.areas.push_back(area);
    }
    layout.bottom += kPanelTitleRoom + height + below + kLineHeight + 2;
  }
  return layout;
}

}  // namespace

BoxNumbers box_numbers(std::vector<double> values) {
  std::ranges::sort(values);
  BoxNumbers box{.lower_quartile = type_7_quantile(values, 0.25),
                 .median = type_7_quantile(values, 0.5),
                 .upper_quartile = type_7_quantile(values, 0.75)};
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  box.lower_whisker = *std::ranges::lower_bound(values, box.lower_quartile - reach);
  box.upper_whisker = *std::prev(std::ranges::upper_bound(values, box.upper_quartile + reach));
  // No value may lie between a quartile and the end of its whisker.
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
                         kLineHeight * static_cast<double>(plot.details.size()) + 2;
  const BoxLayout layout = layout_of(plot, grid, heading + kLineHeight);
  const auto explanation = broken_text(kExplanation, kTextSize, plot.width_mm - 2 * kMargin, 6);
  const double bottom = layout.bottom + kLineHeight * static_cast<double>(explanation.size());
  Svg svg(plot.width_mm, bottom + kMargin, plot.title,
          fmt::format("Box plots with points in {} panels; {}", plot.panels.size(), plot.axis));
  const double top = draw_heading(svg, plot.title, plot.details);
  const TextStyle ink{.size = kTextSize, .fill = std::string(kInk)};
  svg.text({kMargin, top + kTextSize}, fitted_text(plot.axis, kTextSize, plot.width_mm - 4), ink);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    draw_panel_title(svg, plot.panels[i].title, grid.left_of(i), layout.areas[i].top, grid.width());
    draw_panel(svg, plot.panels[i], layout.areas[i]);
  }
  for (std::size_t i = 0; i < explanation.size(); ++i) {
    svg.text({kMargin, layout.bottom + kLineHeight * static_cast<double>(i) + kTextSize},
             explanation[i], ink);
  }
  return svg.finish();
}

Expected<Figure> box_figure(StoreReader& store, const FigureOptions& options) {
  auto scores = grouped_scores(store, options);
  if (!scores) return Unexpected(scores.error());
  const BoxPlot plot{.title = "Scores by " + scores->by,
                     .details = std::move(scores->details),
                     .panels = std::move(scores->panels),
                     .width_mm = options.width_mm};
  return Figure{.svg = draw(plot), .csv = std::move(scores->csv), .tex = {}};
}

}  // namespace swarmsmith
