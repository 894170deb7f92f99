#pragma once

#include <array>
#include <vector>

#include "analysis/machines/internal/machine_labels.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// Labels of modules as lines of text, and the shapes that are large enough for them. Lengths are
/// mm.

inline constexpr double kLinePitch = 1.25;  ///< of lines, by their size
inline constexpr double kMiddle = 0.35;     ///< from a base line up to the middle of its letters

/// 6 points at least; more where there is room.
struct LabelSizes {
  double state;
  double condition;
};
LabelSizes label_sizes(double width_mm);

/// Lines centred on the origin.
std::vector<LabelLine> lines_of(const ModuleLabel& label, double size);

void move_lines(std::vector<LabelLine>& lines, PagePoint by);

/// Of the smallest circle round lines that are centred on the origin.
double radius_round(const std::vector<LabelLine>& lines);

/// Of the smallest pointed box round the lines, with its points.
double box_width(const std::vector<LabelLine>& lines);
double box_height(const std::vector<LabelLine>& lines);

/// The box's corners, from the left point clockwise.
std::array<PagePoint, 6> pointed_box(PagePoint centre, double width, double height);

}  // namespace swarmsmith
