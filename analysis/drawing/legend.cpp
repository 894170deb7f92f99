#include "analysis/drawing/legend.h"

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/drawing/figure_style.h"

namespace swarmsmith {
namespace {

constexpr double kSwatch = 2.4;
constexpr double kSwatchSpace = 4;
constexpr double kBetween = 2;  ///< between the entries of a flowing legend

void draw_entry(Svg& svg, const LegendEntry& entry, PagePoint at) {
  double indent = 0;
  if (!entry.color.empty()) {
    const auto [x, y] = at;
    const std::array<PagePoint, 4> box = {
        {{x, y}, {x + kSwatch, y}, {x + kSwatch, y + kSwatch}, {x, y + kSwatch}}};
    svg.polygon(box, filled(entry.color));
    indent = kSwatch + 0.8;
  }
  svg.text({at.x + indent, at.y + 2.2}, entry.text, {.size = kTextSize, .fill = std::string(kInk)});
}

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double width) : entries_(std::move(entries)) {
  double widest = 1;
  for (LegendEntry& entry : entries_) {
    entry.text = fitted_text(entry.text, kTextSize, width - kSwatchSpace);
    widest = std::max(widest, text_width(entry.text, kTextSize));
  }
  columns_ = static_cast<std::size_t>(width / (widest + kSwatchSpace));
  columns_ = std::clamp<std::size_t>(columns_, 1, std::max<std::size_t>(1, entries_.size()));
  column_width_ = width / static_cast<double>(columns_);
}

double Legend::height() const {
  const std::size_t rows = (entries_.size() + columns_ - 1) / columns_;
  return kLineHeight * static_cast<double>(rows);
}

void Legend::draw(Svg& svg, double top) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::size_t row = i / columns_;
    const double x = kMargin + column_width_ * static_cast<double>(i % columns_);
    const double y = top + kLineHeight * static_cast<double>(row);
    draw_entry(svg, entries_[i], {x, y});
  }
}

FlowingLegend::FlowingLegend(std::vector<LegendEntry> entries, double width)
    : entries_(std::move(entries)) {
  PagePoint place;
  for (LegendEntry& entry : entries_) {
    const double swatch = entry.color.empty() ? 0 : kSwatchSpace;
    entry.text = fitted_text(entry.text, kTextSize, width - swatch);
    const double needed = swatch + text_width(entry.text, kTextSize);
    if (place.x > 0 && place.x + needed > width) place = {0, place.y + kLineHeight};
    places_.push_back(place);
    place.x += needed + kBetween;
  }
}

double FlowingLegend::height() const {
  return places_.empty() ? 0 : places_.back().y + kLineHeight;
}

void FlowingLegend::draw(Svg& svg, double top) const {
  for (std::size_t i = 0; i < entries_.size(); ++i)
    draw_entry(svg, entries_[i], {kMargin + places_[i].x, top + places_[i].y});
}

}  // namespace swarmsmith
