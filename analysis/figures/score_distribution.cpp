#include "analysis/figures/score_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/panel_grid.h"
#include "analysis/figures/internal/score_grid.h"
#include "analysis/figures/internal/score_groups.h"
#include "analysis/figures/makers.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kLeastHistogram = 38;
constexpr double kHistogramRatio = 0.62;
constexpr double kBars = 0.8;  ///< part of a bin's width that its bars fill
constexpr double kShareSize = 2.2;
constexpr std::string_view kShare = "share of the group's scores, %";

std::vector<double> values_of(const ScorePanel& panel) {
  std::vector<double> all;
  for (const ScoreGroup& group : panel.groups)
    all.insert(all.end(), group.values.begin(), group.values.end());
  return all;
}

/// The number of values in each bin.
std::vector<std::size_t> counts_of(const ScoreGroup& group, const ScoreBins& bins) {
  std::vector<std::size_t> counts(bins.count, 0);
  for (const double value : group.values)
    ++counts[bins.bin_of(value)];
  return counts;
}

double percent(std::size_t count, const ScoreGroup& group) {
  return 100 * static_cast<double>(count) / static_cast<double>(group.values.size());
}

/// From 0 to the highest bar of the panel, rounded up.
ValueRange shares_of(const ScorePanel& panel, const ScoreBins& bins) {
  double most = 1;
  for (const ScoreGroup& group : panel.groups)
    for (const std::size_t count : counts_of(group, bins))
      most = std::max(most, percent(count, group));
  return rounded({0, most}, kUsualTicks);
}

double edge_of(const ScoreBins& bins, std::size_t number) {
  return bins.low + bins.width * static_cast<double>(number);
}

ValueRange range_of(const ScoreBins& bins) {
  return {bins.low, edge_of(bins, bins.count)};
}

/// The width of the widest label at the ends of bins.
double widest_edge(const ScoreBins& bins) {
  double widest = 0;
  for (std::size_t i = 0; i <= bins.count; ++i)
    widest = std::max(widest, text_width(tick_text(edge_of(bins, i), bins.width), kTextSize));
  return widest;
}

/// The panel's area. In a histogram, tick labels extend beyond its ends.
PlotArea histogram_area(const ScorePanel& panel, double left, double top, double width) {
  const ScoreBins bins = score_bins(values_of(panel));
  const double beyond = bins.single ? 0 : widest_edge(bins) / 2;
  const double room = std::max(beyond, tick_room(shares_of(panel, bins), kUsualTicks));
  return {.left = left + room, .top = top, .width = width - room - beyond};
}

std::string axis_label(const ScoreBins& bins) {
  if (bins.single) return "score";
  return fmt::format("score, in bins of {}", tick_text(bins.width, bins.width));
}

void draw_edge(Svg& svg, PagePoint a, PagePoint b) {
  const std::array<PagePoint, 2> ends = {a, b};
  svg.line(ends, stroked(kInk, 0.2));
}

void draw_bar(Svg& svg, double left, double right, double top, double bottom,
              const std::string& color) {
  const std::array<PagePoint, 4> corners = {
      {{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
  svg.polygon(corners, filled(color));
}

/// Draws bars side by side within each bin, and their counts above them if the bars are wide
/// enough.
void draw_bars(Svg& svg, const ScorePanel& panel, const ScoreBins& bins, const PlotArea& area,
               const Axis& y) {
  const Bands bands(bins.count, area.left, area.right());
  const double bar = kBars * bands.width() / static_cast<double>(panel.groups.size());
  std::size_t most = 0;
  for (const ScoreGroup& group : panel.groups)
    most = std::max(most, std::ranges::max(counts_of(group, bins)));
  const bool has_room = text_width(fmt::format("{}", most), kShareSize) <= bar;
  for (std::size_t g = 0; g < panel.groups.size(); ++g) {
    const ScoreGroup& group = panel.groups[g];
    const auto counts = counts_of(group, bins);
    for (std::size_t bin = 0; bin < bins.count; ++bin) {
      if (counts[bin] == 0) continue;
      const double left =
          bands.centre(bin) - kBars * bands.width() / 2 + static_cast<double>(g) * bar;
      const double top = y.at(percent(counts[bin], group));
      draw_bar(svg, left, left + bar, top, area.bottom(), distinct_color(group.color));
      if (!has_room) continue;
      svg.text(
          {left + bar / 2, top - 0.5}, fmt::format("{}", counts[bin]),
          {.size = kShareSize, .anchor = TextStyle::Anchor::Middle, .fill = std::string(kInk)});
    }
  }
}

/// Draws the axis of a histogram: its ticks are ends of bins, as many as fit.
void draw_edges(Svg& svg, const ScoreBins& bins, const PlotArea& area) {
  const Axis x(range_of(bins), area.left, area.right());
  const double apart = area.width / static_cast<double>(bins.count);
  const auto every = static_cast<std::size_t>(std::ceil((widest_edge(bins) + 1) / apart));
  draw_edge(svg, {area.left, area.bottom()}, {area.right(), area.bottom()});
  const TextStyle middle{
      .size = kTextSize, .anchor = TextStyle::Anchor::Middle, .fill = std::string(kInk)};
  for (std::size_t i = 0; i <= bins.count; i += every) {
    const double at = x.at(edge_of(bins, i));
    draw_edge(svg, {at, area.bottom()}, {at, area.bottom() + 1});
    svg.text({at, area.bottom() + 1 + kTextSize}, tick_text(edge_of(bins, i), bins.width), middle);
  }
  svg.text({area.left + area.width / 2, area.bottom() + 1 + kTextSize + kLineHeight},
           axis_label(bins), middle);
}

void draw_histogram(Svg& svg, const ScorePanel& panel, const PlotArea& area) {
  const ScoreBins bins = score_bins(values_of(panel));
  // Leaves room for the count above the highest bar.
  const Axis y(shares_of(panel, bins), area.bottom(), area.top + 2);
  draw_vertical_axis(svg, area, y, "");
  draw_bars(svg, panel, bins, area, y);
  if (!bins.single) return draw_edges(svg, bins, area);
  std::vector<std::string> names;
  for (std::size_t bin = 0; bin < bins.count; ++bin)
    names.push_back(tick_text(bins.low + static_cast<double>(bin), 1));
  const Bands bands(bins.count, area.left, area.right());
  draw_band_axis(svg, area, bands, names);
  svg.text({area.left + area.width / 2, area.bottom() + band_axis_room(bands, names) + kTextSize},
           axis_label(bins),
           {.size = kTextSize, .anchor = TextStyle::Anchor::Middle, .fill = std::string(kInk)});
}

/// Keeps the store's colours if no two groups share a colour, else assigns new ones. Returns the
/// number of groups.
std::size_t give_each_a_color(ScoreDistribution& plot) {
  std::map<std::string, std::size_t> colors;
  std::set<std::size_t> taken;
  for (const ScorePanel& panel : plot.panels) {
    for (const ScoreGroup& group : panel.groups) {
      if (colors.try_emplace(group.name, group.color).second) taken.insert(group.color);
    }
  }
  if (taken.size() < colors.size()) {
    std::size_t next = 0;
    for (auto& color : colors)
      color.second = next++;
  }
  for (ScorePanel& panel : plot.panels) {
    for (ScoreGroup& group : panel.groups)
      group.color = colors.at(group.name);
  }
  for (const auto& [name, color] : colors) {
    plot.groups.resize(std::max(plot.groups.size(), color + 1));
    plot.groups[color] = name;
  }
  return colors.size();
}

Legend legend_of(const ScoreDistribution& plot) {
  std::vector<LegendEntry> entries;
  for (std::size_t color = 0; color < plot.groups.size(); ++color) {
    if (!plot.groups[color].empty()) entries.push_back({distinct_color(color), plot.groups[color]});
  }
  return {std::move(entries), plot.width_mm - 2 * kMargin};
}

}  // namespace

std::size_t ScoreBins::bin_of(double value) const {
  // A score on an edge belongs to the bin above it, even if the division rounds down.
  const double place = std::floor((value - low) / width + 1e-9);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
}

ScoreBins score_bins(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  const bool whole = std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
  if (whole && most - least < static_cast<double>(kMostSingleBins))
    return {least, 1, static_cast<std::size_t>(most - least) + 1, true};
  // Sturges 1926: a number of bins that grows with the logarithm of n.
  const double sturges = std::ceil(std::log2(static_cast<double>(values.size()))) + 1;
  ScoreBins bins;
  bins.width = tick_step(range_over(values), static_cast<std::size_t>(std::max(5.0, sturges)));
  const double first = std::floor(least / bins.width + 1e-9);
  const double last = std::floor(most / bins.width + 1e-9);
  bins.low = first * bins.width;
  bins.count = static_cast<std::size_t>(last - first) + 1;
  return bins;
}

std::string draw(const ScoreDistribution& plot) {
  const PanelGrid grid(plot.panels.size(), kLeastHistogram, plot.width_mm);
  const double height = std::clamp(kHistogramRatio * grid.width(), 30.0, 50.0);
  const double row = kPanelTitleRoom + height + kHorizontalAxisRoom + 3;
  const double first = kMargin + (plot.title.empty() ? 0 : kTitleSize) +
                       kLineHeight * static_cast<double>(plot.details.size() + 1) + 2;
  const double bottom = first + row * static_cast<double>(grid.rows());
  const Legend legend = legend_of(plot);
  Svg svg(plot.width_mm, bottom + legend.height() + kMargin, plot.title,
          fmt::format("Bars of how often scores occurred, in {}",
                      counted(plot.panels.size(), "panel")));
  const double top = draw_heading(svg, plot.title, plot.details);
  svg.text({kMargin, top + kTextSize}, kShare, {.size = kTextSize, .fill = std::string(kInk)});
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    PlotArea area = histogram_area(
        plot.panels[i], grid.left_of(i),
        first + row * static_cast<double>(grid.row_of(i)) + kPanelTitleRoom, grid.width());
    area.height = height;
    draw_panel_title(svg, plot.panels[i].title, grid.left_of(i), area.top, grid.width());
    draw_histogram(svg, plot.panels[i], area);
  }
  legend.draw(svg, bottom);
  return svg.finish();
}

Expected<Figure> scores_figure(StoreReader& store, const FigureOptions& options) {
  auto scores = grouped_scores(store, options);
  if (!scores) return Unexpected(scores.error());
  ScoreDistribution plot{.title = "Distribution of scores",
                         .details = std::move(scores->details),
                         .panels = std::move(scores->panels),
                         .width_mm = options.width_mm};
  plot.details.front() += "; higher is better";
  const std::size_t groups = give_each_a_color(plot);
  if (groups > kDistinctColors) {
    const auto names = names_with_sources(store);
    if (!names) return Unexpected(names.error());
    if (names->sources.size() > kDistinctColors)
      return bad_input(
          fmt::format("{} sources need as many colours; choose a --source", names->sources.size()),
          "figure scores");
    return Figure{.svg = draw_score_grid(for_paper(plot, options), names->sources),
                  .csv = std::move(scores->csv),
                  .tex = {}};
  }
  return Figure{.svg = draw(for_paper(plot, options)), .csv = std::move(scores->csv), .tex = {}};
}

}  // namespace swarmsmith
