#pragma once

#include <algorithm>
#include <cstddef>

#include <string>

#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Panels of equal width in rows; a row has as many panels as fit with their minimum width.
class PanelGrid {
 public:
  PanelGrid(std::size_t panels, double least_width, double page_width) : panels_(panels) {
    const double room = page_width - 2 * kMargin;
    columns_ = static_cast<std::size_t>((room + kGap) / (least_width + kGap));
    columns_ = std::clamp<std::size_t>(columns_, 1, std::max<std::size_t>(1, panels));
    // Fills the last row as much as the others, if this needs no additional row.
    columns_ = (panels_ + rows() - 1) / std::max<std::size_t>(1, rows());
    columns_ = std::max<std::size_t>(1, columns_);
    width_ = (room + kGap) / static_cast<double>(columns_) - kGap;
  }

  std::size_t rows() const { return (panels_ + columns_ - 1) / columns_; }
  std::size_t row_of(std::size_t panel) const { return panel / columns_; }
  double left_of(std::size_t panel) const {
    return kMargin + static_cast<double>(panel % columns_) * (width_ + kGap);
  }
  double width() const { return width_; }

 private:
  static constexpr double kGap = 3;

  std::size_t panels_;
  std::size_t columns_ = 1;
  double width_ = 0;
};

/// Draws a panel's name in bold above its area, which begins at `area_top`.
void draw_panel_title(Svg& svg, const std::string& title, double left, double area_top,
                      double width);
/// The height of the panel's name above the area.
inline constexpr double kPanelTitleRoom = kLineHeight + 2;

}  // namespace swarmsmith
