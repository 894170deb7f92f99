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

namespace swarmsmith {
namespace {

constexpr double kSmallText = 2.3;
constexpr double kSmallLine = 2.7;
constexpr double kInactive = 7;    ///< width of the place of what is not active
constexpr double kNamePart = 0.3;  ///< of the figure's width, at most
constexpr double kFan = 0.065;     ///< of the figure's width: free height between two axes
constexpr double kPaleness = 0.35;
constexpr std::size_t kCaptionLines = 8;
constexpr std::size_t kMostTicks = 5;
constexpr std::size_t kMostLabelLines = 3;
constexpr std::size_t kStripParts = 24;
constexpr std::string_view kScoreName = "mean score";
constexpr std::string_view kAxisColor = "#777777";

struct Label {
  double x = 0;  ///< middle
  std::string text;
  std::size_t line = 0;
};

/// Places and texts of all axes, mm.
class Layout {
 public:
  explicit Layout(const ParallelPlot& plot) : plot_(plot) {
    double names = text_width(kScoreName, kTextSize);
    for (const auto& parameter : plot.parameters)
      names = std::max(names, text_width(parameter.name, kTextSize));
    names_ = std::min(names, kNamePart * plot.width_mm);
    inactive_left_ = kMargin + names_ + 1.5;
    left_ = inactive_left_ + kInactive + 2;
    right_ = plot.width_mm - kMargin - 3;
    std::vector<double> means;
    for (const auto& line : plot.lines)
      means.push_back(line.mean);
    scores_ = rounded(range_over(means), kMostTicks);
    double y = kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 3 +
               kLineHeight;
    for (std::size_t i = 0; i < plot.parameters.size(); ++i) {
      labels_.push_back(labels_of(plot.parameters[i]));
      rows_.push_back(y);
      std::size_t lines = 1;
      for (const Label& label : labels_.back())
        lines = std::max(lines, label.line + 1);
      label_ends_.push_back(y + 1 + kSmallLine * static_cast<double>(lines));
      y = label_ends_.back() + kFan * plot.width_mm;
    }
    score_row_ = y;
  }

  double left() const { return left_; }
  double right() const { return right_; }
  double names() const { return names_; }
  double inactive_left() const { return inactive_left_; }
  double row(std::size_t parameter) const { return rows_[parameter]; }
  /// Below the labels of an axis.
  double label_end(std::size_t parameter) const { return label_ends_[parameter]; }
  double score_row() const { return score_row_; }
  ValueRange scores() const { return scores_; }
  const std::vector<Label>& labels(std::size_t parameter) const { return labels_[parameter]; }
  double score_at(double mean) const { return Axis(scores_, left_, right_).at(mean); }

  /// `spread` in [-0.5, 0.5] keeps lines through one category apart.
  double at(std::size_t parameter, double value, double spread) const {
    const auto& drawn = plot_.parameters[parameter];
    if (std::isnan(value)) return inactive_left_ + kInactive * (0.5 + 0.8 * spread);
    if (!drawn.categories.empty()) {
      const Bands bands(drawn.categories.size(), left_, right_);
      return bands.centre(static_cast<std::size_t>(value)) + 0.6 * bands.width() * spread;
    }
    return Axis(range_of(drawn), left_, right_).at(value);
  }

 private:
  static ValueRange range_of(const ParallelPlot::Parameter& parameter) {
    return range_over({parameter.low, parameter.high});
  }

  /// Three numbers, or all categories: in as few lines by turns as they fit in, at most three, and
  /// shortened where that is not enough.
  std::vector<Label> labels_of(const ParallelPlot::Parameter& parameter) const {
    std::vector<Label> labels;
    if (parameter.categories.empty()) {
      const Axis axis(range_of(parameter), left_, right_);
      const double middle = (parameter.low + parameter.high) / 2;
      // Round ticks would hide the ends, which say how far the values go.
      for (const double value : {parameter.low, middle, parameter.high})
        labels.push_back({axis.at(value), fmt::format("{:.4g}", value), 0});
      if (parameter.low == parameter.high) labels.resize(1);
      return labels;
    }
    const Bands bands(parameter.categories.size(), left_, right_);
    double widest = 0;
    for (const std::string& name : parameter.categories)
      widest = std::max(widest, text_width(name, kSmallText) + 1);
    std::size_t lines = 1;
    while (lines < kMostLabelLines && widest > static_cast<double>(lines) * bands.width())
      ++lines;
    // Places of labels of one line touch nowhere, also where the ends of the axis cut them.
    const double half = static_cast<double>(lines) * bands.width() / 2 - 0.5;
    for (std::size_t i = 0; i < parameter.categories.size(); ++i) {
      const double from = std::max(bands.centre(i) - half, left_ - 1.5);
      const double to = std::min(bands.centre(i) + half, right_ + 3);
      const std::string text = fitted_text(parameter.categories[i], kSmallText, to - from);
      const double text_half = std::min(text_width(text, kSmallText), to - from) / 2;
      labels.push_back(
          {std::clamp(bands.centre(i), from + text_half, to - text_half), text, i % lines});
    }
    return labels;
  }

  const ParallelPlot& plot_;
  double names_ = 0;
  double inactive_left_ = 0;
  double left_ = 0;
  double right_ = 0;
  ValueRange scores_;
  std::vector<double> rows_;
  std::vector<double> label_ends_;
  double score_row_ = 0;
  std::vector<std::vector<Label>> labels_;
};

TextStyle ink(TextStyle::Anchor anchor, double size = kTextSize) {
  return {.size = size, .anchor = anchor, .fill = std::string(kInk)};
}

void draw_rule(Svg& svg, double left, double right, double y) {
  const std::array<PagePoint, 2> ends = {{{left, y}, {right, y}}};
  svg.line(ends, stroked(kAxisColor, 0.25));
}

std::string color_of(const Layout& at, double mean) {
  const ValueRange range = at.scores();
  return sequential_color((mean - range.low) / (range.high - range.low));
}

/// Golden-ratio steps: neighbours fall far from each other, the same at every drawing.
double spread_of(std::size_t line) {
  const double place = 0.61803398875 * static_cast<double>(line + 1);
  return place - std::floor(place) - 0.5;
}

void draw_lines(Svg& svg, const ParallelPlot& plot, const Layout& at) {
  std::vector<std::size_t> order(plot.lines.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  // The good ones on top of the bad ones, elites on top of all.
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (plot.lines[a].is_elite != plot.lines[b].is_elite) return plot.lines[b].is_elite;
    return plot.lines[a].mean < plot.lines[b].mean;
  });
  for (const std::size_t i : order) {
    const ParallelPlot::Line& line = plot.lines[i];
    std::vector<PagePoint> points;
    for (std::size_t p = 0; p < plot.parameters.size(); ++p) {
      // Straight behind the labels, so that one sees a line go on below the label that hides it.
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

/// A text on a white ground, so that lines behind it do not cross it out.
void draw_label(Svg& svg, PagePoint base_line, const std::string& text) {
  const double half = text_width(text, kSmallText) / 2;
  const std::array<PagePoint, 4> ground = {{{base_line.x - half, base_line.y - 0.8 * kSmallText},
                                            {base_line.x + half, base_line.y - 0.8 * kSmallText},
                                            {base_line.x + half, base_line.y + 0.25 * kSmallText},
                                            {base_line.x - half, base_line.y + 0.25 * kSmallText}}};
  svg.polygon(ground, filled("#ffffff"));
  svg.text(base_line, text, ink(TextStyle::Anchor::Middle, kSmallText));
}

void draw_axes(Svg& svg, const ParallelPlot& plot, const Layout& at) {
  for (std::size_t p = 0; p < plot.parameters.size(); ++p) {
    const double y = at.row(p);
    draw_rule(svg, at.left(), at.right(), y);
    const bool has_inactive = std::ranges::any_of(
        plot.lines, [&](const ParallelPlot::Line& line) { return std::isnan(line.values[p]); });
    if (has_inactive) draw_rule(svg, at.inactive_left(), at.inactive_left() + kInactive, y);
    svg.text({kMargin, y + 0.36 * kTextSize},
             fitted_text(plot.parameters[p].name, kTextSize, at.names()),
             ink(TextStyle::Anchor::Start));
    for (const Label& label : at.labels(p)) {
      draw_label(svg,
                 {label.x, y + 0.6 + kSmallText + kSmallLine * static_cast<double>(label.line)},
                 label.text);
    }
  }
}

/// The axis of the score is the legend of the colours, too.
void draw_score_axis(Svg& svg, const Layout& at) {
  constexpr double kStrip = 1.4;
  const double y = at.score_row();
  const double part = (at.right() - at.left()) / kStripParts;
  for (std::size_t i = 0; i < kStripParts; ++i) {
    const PageBar bar = {{at.left() + part * static_cast<double>(i), y + kStrip / 2}, part + 0.01};
    svg.bars({&bar, 1}, kStrip,
             sequential_color((static_cast<double>(i) + 0.5) / static_cast<double>(kStripParts)));
  }
  const double step = tick_step(at.scores(), kMostTicks);
  for (const double tick : ticks_in(at.scores(), step)) {
    svg.text({at.score_at(tick), y + kStrip + 0.6 + kSmallText}, tick_text(tick, step),
             ink(TextStyle::Anchor::Middle, kSmallText));
  }
  svg.text({kMargin, y + 0.36 * kTextSize + kStrip / 2},
           fitted_text(kScoreName, kTextSize, at.names()), ink(TextStyle::Anchor::Start));
  svg.text({(at.left() + at.right()) / 2, y + kStrip + 0.6 + kSmallText + kLineHeight},
           "higher is better", ink(TextStyle::Anchor::Middle));
}

std::string description_of(const ParallelPlot& plot) {
  const auto elites = std::ranges::count(plot.lines, true, &ParallelPlot::Line::is_elite);
  std::string text = fmt::format("Parallel coordinates of {} elites and {} other candidates over",
                                 elites, static_cast<std::ptrdiff_t>(plot.lines.size()) - elites);
  for (const auto& parameter : plot.parameters)
    text += " " + parameter.name + ",";
  return text + " and their mean scores. " + plot.caption;
}

}  // namespace

std::string draw(const ParallelPlot& plot) {
  const Layout at(plot);
  const std::vector<std::string> caption =
      broken_text(plot.caption, kTextSize, plot.width_mm - 2 * kMargin, kCaptionLines);
  const double caption_top = at.score_row() + 2 + kSmallText + 2 * kLineHeight + 1.5;
  Svg svg(plot.width_mm,
          caption_top + kLineHeight * static_cast<double>(caption.size()) - kTextSize + kMargin,
          plot.title, description_of(plot));
  const double head = draw_heading(svg, plot.title, plot.details);
  svg.text({at.inactive_left() - 1, head + kTextSize}, "not active",
           ink(TextStyle::Anchor::Start, kSmallText));
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
