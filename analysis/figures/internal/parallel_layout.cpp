#include "analysis/figures/internal/parallel_layout.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"

namespace swarmsmith {
namespace {

constexpr double kNamePart = 0.3;  ///< maximum part of the figure's width
constexpr double kFan = 0.065;     ///< free height between two axes, relative to the figure's width
constexpr std::size_t kMostLabelLines = 5;

ValueRange range_of(const ParallelPlot::Parameter& parameter) {
  return range_over({parameter.low, parameter.high});
}

}  // namespace

ParallelLayout::ParallelLayout(const ParallelPlot& plot) : plot_(plot) {
  double names = text_width(kScoreName, kTextSize);
  for (const auto& parameter : plot.parameters)
    names = std::max(names, text_width(parameter.name, kTextSize));
  names_ = std::min(names, kNamePart * plot.width_mm);
  inactive_left_ = kMargin + names_ + 1.5;
  left_ = inactive_left_ + kInactivePlace + 2;
  right_ = plot.width_mm - kMargin - 3;
  std::vector<double> means;
  for (const auto& line : plot.lines)
    means.push_back(line.mean);
  scores_ = rounded(range_over(means), kScoreTicks);
  double y = kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 3 +
             kLineHeight;
  for (std::size_t i = 0; i < plot.parameters.size(); ++i) {
    labels_.push_back(labels_of(plot.parameters[i]));
    rows_.push_back(y);
    std::size_t lines = 1;
    for (const Label& label : labels_.back())
      lines = std::max(lines, label.line + 1);
    label_ends_.push_back(y + 1 + kAxisTextLine * static_cast<double>(lines));
    y = label_ends_.back() + kFan * plot.width_mm;
  }
  score_row_ = y;
}

double ParallelLayout::at(std::size_t parameter, double value, double spread) const {
  const auto& drawn = plot_.parameters[parameter];
  if (std::isnan(value)) return inactive_left_ + kInactivePlace * (0.5 + 0.8 * spread);
  if (drawn.categories.empty()) return Axis(range_of(drawn), left_, right_).at(value);
  const Bands bands(drawn.categories.size(), left_, right_);
  return bands.centre(static_cast<std::size_t>(value)) + 0.6 * bands.width() * spread;
}

/// Both ends, which show the range of the values, and the middle.
std::vector<ParallelLayout::Label> ParallelLayout::number_labels(
    const ParallelPlot::Parameter& parameter) const {
  std::vector<Label> labels;
  const Axis axis(range_of(parameter), left_, right_);
  const double middle = (parameter.low + parameter.high) / 2;
  for (const double value : {parameter.low, middle, parameter.high}) {
    const std::string text = fmt::format("{:.4g}", value);
    const double most = plot_.width_mm - 0.5 - text_width(text, kAxisText) / 2;
    labels.push_back({std::min(axis.at(value), most), text, 0});
  }
  if (parameter.low == parameter.high) labels.resize(1);
  return labels;
}

/// All categories, on alternating lines: as few lines as possible, at most five. Labels that still
/// do not fit are shortened.
std::vector<ParallelLayout::Label> ParallelLayout::labels_of(
    const ParallelPlot::Parameter& parameter) const {
  if (parameter.categories.empty()) return number_labels(parameter);
  std::vector<Label> labels;
  const Bands bands(parameter.categories.size(), left_, right_);
  double widest = 0;
  for (const std::string& name : parameter.categories)
    widest = std::max(widest, text_width(name, kAxisText) + 1);
  std::size_t lines = 1;
  while (lines < kMostLabelLines && widest > static_cast<double>(lines) * bands.width())
    ++lines;
  // Labels on the same line do not touch, even where the ends of the axis limit them.
  const double half = static_cast<double>(lines) * bands.width() / 2 - 0.5;
  for (std::size_t i = 0; i < parameter.categories.size(); ++i) {
    const double from = std::max(bands.centre(i) - half, left_ - 1.5);
    const double to = std::min(bands.centre(i) + half, right_ + 3);
    const std::string text = fitted_text(parameter.categories[i], kAxisText, to - from);
    const double text_half = std::min(text_width(text, kAxisText), to - from) / 2;
    labels.push_back(
        {std::clamp(bands.centre(i), from + text_half, to - text_half), text, i % lines});
  }
  return labels;
}

}  // namespace swarmsmith
