#include "analysis/figures/convergence_plot.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/stairs.h"

namespace swarmsmith {
namespace {

constexpr double kAreaRatio = 0.62;   ///< height of an area relative to its width
constexpr double kWideFigure = 120;   ///< mm: from this width on, two panels are side by side
constexpr double kLabelAbove = 2.4;   ///< keeps the label away from the label of the highest tick
constexpr double kBetweenPanels = 4;  ///< between panels
constexpr std::size_t kCrowd =
    5;  ///< from this number of lines on, a group is drawn with its median
constexpr std::string_view kScoreLabel = "mean score (higher is better)";

using Line = ConvergencePlot::Line;
using Panel = ConvergencePlot::Panel;

bool has_band(const ConvergencePlot& plot) {
  return plot.panels.size() == 1 && plot.panels.front().lines.size() == 1;
}

std::size_t lines_of(const Panel& panel, std::size_t group) {
  return static_cast<std::size_t>(std::ranges::count(panel.lines, group, &Line::group));
}

/// Always asks for the same number of ticks, so that the width of their labels is known.
ValueRange scores_of(const Panel& panel, bool with_elites) {
  std::vector<double> means;
  for (const Line& line : panel.lines) {
    for (const auto& point : line.points) {
      means.push_back(point.mean);
      if (!with_elites) continue;
      means.push_back(point.least_elite);
      means.push_back(point.largest_elite);
    }
  }
  return rounded(range_over(means), kUsualTicks);
}

double last_experiment(const ConvergencePlot& plot) {
  double last = 1;
  for (const Panel& panel : plot.panels)
    for (const Line& line : panel.lines)
      if (!line.points.empty()) last = std::max(last, line.points.back().experiments);
  return last;
}

Legend legend_of(const ConvergencePlot& plot) {
  std::vector<LegendEntry> entries;
  for (std::size_t group = 0; group < plot.groups.size(); ++group) {
    const auto has_lines = [&](std::size_t least) {
      return std::ranges::any_of(
          plot.panels, [&](const Panel& panel) { return lines_of(panel, group) >= least; });
    };
    if (!has_lines(1)) continue;
    const bool is_crowd = has_lines(kCrowd);
    entries.push_back(
        {distinct_color(group), plot.groups[group] + (is_crowd ? " (bold: median)" : "")});
  }
  if (has_band(plot))
    entries.push_back({lightened(distinct_color(plot.panels.front().lines.front().group), 0.75),
                       "least to best elite"});
  return {std::move(entries), plot.width_mm - 2 * kMargin};
}

std::vector<PagePoint> on_page(const std::vector<StairPoint>& points, const Axis& x,
                               const Axis& y) {
  std::vector<PagePoint> result;
  result.reserve(points.size());
  for (const StairPoint& point : points)
    result.push_back({x.at(point.x), y.at(point.y)});
  return result;
}

std::vector<StairPoint> points_of(const Line& line, double ConvergencePlot::Point::*value) {
  std::vector<StairPoint> points;
  for (const auto& point : line.points)
    points.push_back({point.experiments, point.*value});
  return points;
}

void draw_band(Svg& svg, const Line& line, const Axis& x, const Axis& y) {
  using Point = ConvergencePlot::Point;
  std::vector<PagePoint> outline = on_page(stairs(points_of(line, &Point::largest_elite)), x, y);
  const auto below = on_page(stairs(points_of(line, &Point::least_elite)), x, y);
  outline.insert(outline.end(), below.rbegin(), below.rend());
  svg.polygon(outline, filled(lightened(distinct_color(line.group), 0.75)));
}

/// Whether a group has lines with several steps. Searches that report their best only once or twice
/// are drawn without steps, because all their vertical lines would coincide at the end.
bool has_steps(const Panel& panel, std::size_t group) {
  constexpr std::size_t kFew = 2;
  return std::ranges::any_of(panel.lines, [&](const Line& line) {
    return line.group == group && line.points.size() > kFew;
  });
}

/// The median, coordinate by coordinate, of the points that `pick` returns for the lines.
template <class Pick>
StairPoint median_of_points(const std::vector<std::vector<StairPoint>>& lines, const Pick& pick) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const auto& line : lines) {
    if (line.empty()) continue;
    xs.push_back(pick(line).x);
    ys.push_back(pick(line).y);
  }
  std::ranges::sort(xs);
  std::ranges::sort(ys);
  const auto middle = [](const std::vector<double>& sorted) {
    return (sorted[sorted.size() / 2] + sorted[(sorted.size() - 1) / 2]) / 2;
  };
  return {middle(xs), middle(ys)};
}

/// The line that represents a group: the median staircase. Without steps: a line from the median
/// start to the median end, or only the median end.
std::vector<StairPoint> middle_of(const std::vector<std::vector<StairPoint>>& lines,
                                  bool has_steps) {
  if (has_steps) return stairs(median_of(lines));
  const auto is_way = [](const std::vector<StairPoint>& line) { return line.size() > 1; };
  const StairPoint end =
      median_of_points(lines, [](const auto& line) -> const StairPoint& { return line.back(); });
  if (!std::ranges::any_of(lines, is_way)) return {end};
  return {
      median_of_points(lines, [](const auto& line) -> const StairPoint& { return line.front(); }),
      end};
}

void draw_curves(Svg& svg, const Panel& panel, const Axis& x, const Axis& y) {
  for (const Line& line : panel.lines) {
    const bool is_crowd = lines_of(panel, line.group) >= kCrowd;
    std::string color = distinct_color(line.group);
    if (is_crowd) color = lightened(color, 0.5);
    const auto values = points_of(line, &ConvergencePlot::Point::mean);
    const auto points = on_page(has_steps(panel, line.group) ? stairs(values) : values, x, y);
    svg.line(points, stroked(color, is_crowd ? 0.15 : 0.4));
    if (!points.empty()) svg.circle(points.back(), is_crowd ? 0.4 : 0.7, filled(color));
  }
  std::set<std::size_t> groups;
  for (const Line& line : panel.lines)
    groups.insert(line.group);
  for (const std::size_t group : groups) {
    if (lines_of(panel, group) < kCrowd) continue;
    std::vector<std::vector<StairPoint>> all;
    for (const Line& line : panel.lines) {
      if (line.group == group) all.push_back(points_of(line, &ConvergencePlot::Point::mean));
    }
    const auto middle = on_page(middle_of(all, has_steps(panel, group)), x, y);
    if (middle.size() > 1) svg.line(middle, stroked(distinct_color(group), 0.7));
    if (!has_steps(panel, group)) svg.circle(middle.back(), 1, filled(distinct_color(group)));
  }
}

std::string description_of(const ConvergencePlot& plot) {
  std::string text = "Mean score of the best candidate over the experiments used.";
  for (const Panel& panel : plot.panels) {
    text += fmt::format(" {}, {} {}:", panel.name, panel.lines.size(),
                        panel.lines.size() == 1 ? "design" : "designs");
    for (const Line& line : panel.lines) {
      if (!line.points.empty())
        text += fmt::format(" {} ends at {:.4g};", line.name, line.points.back().mean);
    }
    text.back() = '.';
  }
  return text;
}

/// Positions of the panels, mm.
struct CurveLayout {
  ValueRange experiments;
  std::size_t across = 1;
  double room = 0;  ///< width of the scores' labels, left of an area
  double between = kBetweenPanels;
  double pitch = 0;  ///< distance between panels
  double panel_height = 0;
  double head = 0;
  double area_top = 0;  ///< within a panel
  double bottom = 0;    ///< of the last panel

  PlotArea area(std::size_t panel) const {
    const double width = pitch - between - room;
    const std::size_t line = panel / across;
    return {.left = kMargin + pitch * static_cast<double>(panel % across) + room,
            .top = head + panel_height * static_cast<double>(line) + area_top,
            .width = width,
            .height = kAreaRatio * width};
  }
};

CurveLayout layout_of(const ConvergencePlot& plot) {
  CurveLayout at;
  at.experiments = rounded({0, last_experiment(plot)}, kUsualTicks);
  for (const Panel& panel : plot.panels)
    at.room = std::max(at.room, tick_room(scores_of(panel, has_band(plot)), kUsualTicks));
  at.across = plot.width_mm >= kWideFigure && plot.panels.size() > 1 ? 2 : 1;
  // Half of the last tick's label extends beyond its area.
  const double half = text_width(tick_text(at.experiments.high, 1), kTextSize) / 2;
  const double beyond = std::max(2.0, half - kMargin + 1);
  at.between = std::max(kBetweenPanels, beyond + 1);
  at.pitch = (plot.width_mm - 2 * kMargin - beyond + at.between) / static_cast<double>(at.across);
  at.area_top = (plot.panels.size() > 1 ? kLineHeight : 0) + kTextSize + kLabelAbove;
  at.panel_height =
      at.area_top + kAreaRatio * (at.pitch - at.between - at.room) + kHorizontalAxisRoom + 3;
  at.head = kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 2;
  const std::size_t down = (plot.panels.size() + at.across - 1) / at.across;
  at.bottom = at.head + at.panel_height * static_cast<double>(down);
  return at;
}

void draw_panel(Svg& svg, const ConvergencePlot& plot, std::size_t number, const CurveLayout& at) {
  const Panel& panel = plot.panels[number];
  const PlotArea area = at.area(number);
  const double left = area.left - at.room;
  TextStyle words{.size = kTextSize, .fill = std::string(kInk)};
  svg.text({left, area.top - kLabelAbove}, kScoreLabel, words);
  if (plot.panels.size() > 1) {
    words.bold = true;
    svg.text({left, area.top - at.area_top + kTextSize},
             fitted_text(panel.name, kBolder * kTextSize, at.pitch - at.between), words);
  }
  const Axis x(at.experiments, area.left, area.right());
  const Axis y(scores_of(panel, has_band(plot)), area.bottom(), area.top);
  draw_vertical_axis(svg, area, y, "");
  if (has_band(plot)) draw_band(svg, panel.lines.front(), x, y);
  draw_horizontal_axis(svg, area, x, "experiments used");
  draw_curves(svg, panel, x, y);
}

}  // namespace

std::string draw(const ConvergencePlot& plot) {
  const CurveLayout at = layout_of(plot);
  const Legend legend = legend_of(plot);
  Svg svg(plot.width_mm, at.bottom + legend.height() + kMargin, plot.title, description_of(plot));
  draw_heading(svg, plot.title, plot.details);
  for (std::size_t panel = 0; panel < plot.panels.size(); ++panel)
    draw_panel(svg, plot, panel, at);
  legend.draw(svg, at.bottom);
  return svg.finish();
}

}  // namespace swarmsmith
