#pragma once

#include <string>
#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/internal/panel_grid.h"
#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Boxes come in pairs of one name, a narrow one and a wide one.
bool has_pairs(const ScorePanel& panel);
/// Beside the boxes, in their order; of a pair one.
std::vector<std::string> names_of(const ScorePanel& panel);
/// Of a panel's axis.
ValueRange range_of(const ScorePanel& panel);

/// Boxes that lie below each other, their whole names at the left: for names that are too long to
/// stand side by side, and for many boxes.
class BoxRows {
 public:
  /// `most_height`: rows become lower, as far as they can be read, to stay within it.
  BoxRows(const std::vector<ScorePanel>& panels, double page_width, double most_height);

  double height() const;
  void draw(Svg& svg, double top) const;

 private:
  double least_height(const std::string& name) const;
  double row_height(const ScorePanel& panel, std::size_t name) const;
  double height_of(const ScorePanel& panel) const;
  double height_of_row(std::size_t row) const;
  void draw_panel(Svg& svg, const ScorePanel& panel, double left, double top) const;

  const std::vector<ScorePanel>& panels_;
  PanelGrid grid_;
  double names_ = 0;    ///< room for them
  double squeeze_ = 1;  ///< part of the usual height that a row has
};

}  // namespace swarmsmith
