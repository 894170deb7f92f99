#include "analysis/figures/convergence_plot.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/makers.h"

namespace swarmsmith {
namespace {

constexpr double kRatio = 0.62;  ///< height of the area by its width
constexpr std::size_t kMostTicks = 7;
constexpr std::string_view kScoreLabel = "mean score (higher is better)";

std::vector<double> means_of(const ConvergencePlot& plot) {
  std::vector<double> means;
  for (const auto& line : plot.lines)
    for (const auto& point : line.points)
      means.push_back(point.mean);
  return means;
}

double last_experiment(const ConvergencePlot& plot) {
  double last = 0;
  for (const auto& line : plot.lines)
    for (const auto& point : line.points)
      last = std::max(last, point.experiments);
  return last;
}

Legend legend_of(const ConvergencePlot& plot) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < plot.groups.size(); ++i)
    entries.push_back({distinct_color(i), plot.groups[i]});
  return {std::move(entries), plot.width_mm - 2 * kMargin};
}

/// Steps: a mean holds from the end of its iteration to the end of the next one.
std::vector<PagePoint> stairs(const ConvergencePlot::Line& line, const Axis& x, const Axis& y) {
  std::vector<PagePoint> points;
  for (const auto& point : line.points) {
    if (!points.empty()) points.push_back({x.at(point.experiments), points.back().y});
    points.push_back({x.at(point.experiments), y.at(point.mean)});
  }
  return points;
}

}  // namespace

std::string draw(const ConvergencePlot& plot) {
  const ValueRange scores = rounded(range_over(means_of(plot)), kMostTicks);
  const ValueRange experiments = rounded({0, std::max(1.0, last_experiment(plot))}, kMostTicks);
  const Legend legend = legend_of(plot);
  const double room = tick_room(scores, kMostTicks);
  PlotArea area{.left = kMargin + room, .width = plot.width_mm - 2 * kMargin - room - 2};
  area.height = kRatio * area.width;
  area.top = kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 2 +
             kLineHeight;
  const double bottom = area.bottom() + kHorizontalAxisRoom + 3;
  Svg svg(plot.width_mm, bottom + legend.height() + kMargin, plot.title,
          fmt::format("Mean score of the best machine over the experiments used, {} designs",
                      plot.lines.size()));
  draw_heading(svg, plot.title, plot.details);
  const Axis x(experiments, area.left, area.right());
  const Axis y(scores, area.bottom(), area.top);
  draw_vertical_axis(svg, area, y, kScoreLabel);
  draw_horizontal_axis(svg, area, x, "experiments used");
  for (const auto& line : plot.lines) {
    const std::string color = distinct_color(line.color);
    const std::vector<PagePoint> points = stairs(line, x, y);
    svg.line(points, stroked(color, 0.35));
    if (!points.empty()) svg.circle(points.back(), 0.6, filled(color));
  }
  legend.draw(svg, bottom);
  return svg.finish();
}

Expected<Figure> convergence_figure(StoreReader& store, const FigureOptions& options) {
  const auto all = elites(store, options.filter);
  if (!all) return Unexpected(all.error());
  const auto known = designs(store, options.filter);
  if (!known) return Unexpected(known.error());
  if (all->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "no iteration of these designs has ended yet; `swarmsmith ls designs` shows "
                      "what the store has");
  }
  ConvergencePlot plot{.title = "Convergence", .width_mm = options.width_mm};
  std::map<std::string, std::size_t> groups;
  std::map<DesignId, std::size_t> lines;
  for (const DesignRecord& design : *known) {
    const std::string group = design.mission + ", " + design.method;
    const auto [place, is_new] = groups.try_emplace(group, groups.size());
    if (is_new) plot.groups.push_back(group);
    lines[design.design] = plot.lines.size();
    plot.lines.push_back({.name = to_string(design.design), .color = place->second});
  }
  Figure figure{.csv = "design,iteration,experiments_used,candidate,mean,n\r\n"};
  for (const EliteRecord& elite : *all) {
    if (elite.rank != 1) continue;
    plot.lines[lines.at(elite.design)].points.push_back(
        {static_cast<double>(elite.experiments_used), elite.mean});
    figure.csv +=
        fmt::format("{},{},{},{},{},{}\r\n", elite.design.value, elite.iteration,
                    elite.experiments_used, elite.candidate.value, elite.mean, elite.runs);
  }
  figure.svg = draw(plot);
  return figure;
}

}  // namespace swarmsmith
