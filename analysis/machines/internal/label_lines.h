#pragma once

#include <array>
#include <vector>

#include "analysis/machines/internal/machine_labels.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// Labels of modules as lines of text, and the sizes of shapes that contain them. Lengths are mm.

inline constexpr double kLinePitch = 1.25;  ///< distance of lines, relative to their size
inline constexpr double kMiddle =
    0.35;  ///< from the baseline up to the middle of the letters, relative to their size

/// At least 6 points; larger if there is room.
struct LabelSizes {
  double state;
  double condition;
};
LabelSizes label_sizes(double width_mm);

/// The label's lines, centred on the origin.
std::vector<LabelLine> lines_of(const ModuleLabel& label, double size);

void move_lines(std::vector<LabelLine>& lines, PagePoint by);

/// The radius of the smallest circle around lines that are centred on the origin.
double radius_round(const std::vector<LabelLine>& lines);

/// The width and height of the smallest pointed box around the lines, including its points.
double box_width(const std::vector<LabelLine>& lines);
double box_height(const std::vector<LabelLine>& lines);

/// The box's corners, clockwise from the left point.
std::array<PagePoint, 6> pointed_box(PagePoint centre, double width, double height);

}  // namespace swarmsmith
