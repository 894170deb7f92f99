#include "analysis/drawing/legend.h"

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/drawing/figure_style.h"

namespace swarmsmith {
namespace {

constexpr double kSwatch = 2.4;
constexpr double kSwatchSpace = 4;

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
    double indent = 0;
    if (!entries_[i].color.empty()) {
      const std::array<PagePoint, 4> box = {
          {{x, y}, {x + kSwatch, y}, {x + kSwatch, y + kSwatch}, {x, y + kSwatch}}};
      svg.polygon(box, filled(entries_[i].color));
      indent = kSwatch + 0.8;
    }
    svg.text({x + indent, y + 2.2}, entries_[i].text,
             {.size = kTextSize, .fill = std::string(kInk)});
  }
}

}  // namespace swarmsmith
