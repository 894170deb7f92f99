#pragma once

#include <string>
#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/internal/panel_grid.h"
#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Whether boxes come in pairs with the same name, a narrow and a wide one.
bool has_pairs(const ScorePanel& panel);
/// Names beside the boxes, in their order; one name per pair.
std::vector<std::string> names_of(const ScorePanel& panel);
/// The range of a panel's axis.
ValueRange range_of(const ScorePanel& panel);

/// Horizontal boxes one below the other, with their full names at the left: for long names, and for
/// many boxes.
class BoxRows {
 public:
  /// `most_height`: rows are made lower to stay within it, as long as they remain readable.
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
  double names_ = 0;    ///< width of the names
  double squeeze_ = 1;  ///< row height divided by the usual height
};

}  // namespace swarmsmith
