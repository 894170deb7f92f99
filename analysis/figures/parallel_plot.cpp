#include "analysis/figures/parallel_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/parallel_layout.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kPaleness = 0.35;
constexpr double kNameLine = 3.1;
constexpr std::size_t kCaptionLines = 8;
constexpr std::size_t kStripParts = 24;
constexpr std::string_view kAxisColor = "#777777";

void draw_rule(Svg& svg, double left, double right, double y) {
  const std::array<PagePoint, 2> ends = {{{left, y}, {right, y}}};
  svg.line(ends, stroked(kAxisColor, 0.25));
}

std::string color_of(const ParallelLayout& at, double mean) {
  const ValueRange range = at.scores();
  return sequential_color((mean - range.low) / (range.high - range.low));
}

/// Golden-ratio steps: neighbouring lines are far apart, and every drawing has the same result.
double spread_of(std::size_t line) {
  const double place = 0.61803398875 * static_cast<double>(line + 1);
  return place - std::floor(place) - 0.5;
}

void draw_lines(Svg& svg, const ParallelPlot& plot, const ParallelLayout& at) {
  std::vector<std::size_t> order(plot.lines.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  // Good candidates are on top of bad ones, and elites on top of all others.
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (plot.lines[a].is_elite != plot.lines[b].is_elite) return plot.lines[b].is_elite;
    return plot.lines[a].mean < plot.lines[b].mean;
  });
  for (const std::size_t i : order) {
    const ParallelPlot::Line& line = plot.lines[i];
    std::vector<PagePoint> points;
    for (std::size_t p = 0; p < plot.parameters.size(); ++p) {
      // The line is straight behind the labels, so that it visibly continues below a label that
      // hides it.
      const double x = at.at(p, line.values[p], spread_of(i));
      points.push_back({x, at.row(p)});
      points.push_back({x, at.label_end(p)});
    }
    points.push_back({at.score_at(line.mean), at.score_row()});
    const std::string color = color_of(at, line.mean);
    svg.line(points,
             line.is_elite ? stroked(color, 0.5) : stroked(lightened(color, kPaleness), 0.13));
  }
}

/// A text on a white background, so that lines do not cross it.
void draw_label(Svg& svg, PagePoint base_line, const std::string& text) {
  const double half = text_width(text, kAxisText) / 2;
  const std::array<PagePoint, 4> ground = {{{base_line.x - half, base_line.y - 0.8 * kAxisText},
                                            {base_line.x + half, base_line.y - 0.8 * kAxisText},
                                            {base_line.x + half, base_line.y + 0.25 * kAxisText},
                                            {base_line.x - half, base_line.y + 0.25 * kAxisText}}};
  svg.polygon(ground, filled("#ffffff"));
  svg.text(base_line, text, ink(TextStyle::Anchor::Middle, kAxisText));
}

void draw_axes(Svg& svg, const ParallelPlot& plot, const ParallelLayout& at) {
  for (std::size_t p = 0; p < plot.parameters.size(); ++p) {
    const double y = at.row(p);
    draw_rule(svg, at.left(), at.right(), y);
    const bool has_inactive = std::ranges::any_of(
        plot.lines, [&](const ParallelPlot::Line& line) { return std::isnan(line.values[p]); });
    if (has_inactive) draw_rule(svg, at.inactive_left(), at.inactive_left() + kInactivePlace, y);
    const auto lines = whole_lines(plot.parameters[p].name, kTextSize, at.names() + 0.01);
    double base = y + 0.36 * kTextSize - kNameLine * static_cast<double>(lines.size() - 1) / 2;
    for (const std::string& line : lines) {
      svg.text({kMargin, base}, line, ink(TextStyle::Anchor::Start));
      base += kNameLine;
    }
    for (const auto& label : at.labels(p)) {
      draw_label(svg,
                 {label.x, y + 0.6 + kAxisText + kAxisTextLine * static_cast<double>(label.line)},
                 label.text);
    }
  }
}

/// The axis of the score is also the legend of the colours.
void draw_score_axis(Svg& svg, const ParallelLayout& at) {
  constexpr double kStrip = 1.4;
  const double y = at.score_row();
  const double part = (at.right() - at.left()) / kStripParts;
  for (std::size_t i = 0; i < kStripParts; ++i) {
    const PageBar bar = {{at.left() + part * static_cast<double>(i), y + kStrip / 2}, part + 0.01};
    svg.bars({&bar, 1}, kStrip,
             sequential_color((static_cast<double>(i) + 0.5) / static_cast<double>(kStripParts)));
  }
  const double step = at.score_step();
  for (const double tick : ticks_in(at.scores(), step)) {
    svg.text({at.score_at(tick), y + kStrip + 0.6 + kAxisText}, tick_text(tick, step),
             ink(TextStyle::Anchor::Middle, kAxisText));
  }
  svg.text({kMargin, y + 0.36 * kTextSize + kStrip / 2},
           fitted_text(kScoreName, kTextSize, at.names()), ink(TextStyle::Anchor::Start));
  svg.text({(at.left() + at.right()) / 2, y + kStrip + 0.6 + kAxisText + kLineHeight},
           "higher is better", ink(TextStyle::Anchor::Middle));
}

std::string description_of(const ParallelPlot& plot) {
  const auto elites = std::ranges::count(plot.lines, true, &ParallelPlot::Line::is_elite);
  std::string text = fmt::format("Parallel coordinates of {} and {} over", counted(elites, "elite"),
                                 counted(std::ssize(plot.lines) - elites, "other candidate"));
  for (const auto& parameter : plot.parameters)
    text += " " + parameter.name + ",";
  return text + " and their mean scores. " + plot.caption;
}

}  // namespace

std::string draw(const ParallelPlot& plot) {
  const ParallelLayout at(plot);
  const std::vector<std::string> caption =
      broken_text(plot.caption, kTextSize, plot.width_mm - 2 * kMargin, kCaptionLines);
  const double caption_top = at.score_row() + 2 + kAxisText + 2 * kLineHeight + 1.5;
  Svg svg(plot.width_mm,
          caption_top + kLineHeight * static_cast<double>(caption.size()) - kTextSize + kMargin,
          plot.title, description_of(plot));
  const double head = draw_heading(svg, plot.title, plot.details);
  svg.text({at.inactive_left() - 1, head + kTextSize}, "not active",
           ink(TextStyle::Anchor::Start, kAxisText));
  draw_lines(svg, plot, at);
  draw_axes(svg, plot, at);
  draw_score_axis(svg, at);
  for (std::size_t i = 0; i < caption.size(); ++i) {
    svg.text({kMargin, caption_top + kLineHeight * static_cast<double>(i)}, caption[i],
             ink(TextStyle::Anchor::Start));
  }
  return svg.finish();
}

}  // namespace swarmsmith
