#pragma once

#include <string_view>

#include "analysis/drawing/svg.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// What printed sheets have in common: margins that printers can print up to, and a foot with a
/// ruler to measure, since printers scale unless told not to. Lengths are mm.
inline constexpr double kPageMargin = 8;
inline constexpr double kFootHeight = 8;

/// The largest width and height of what stands above the foot.
struct PrintedArea {
  double left = kPageMargin;
  double top = kPageMargin;
  double width = 0;
  double height = 0;
};
PrintedArea printed_area(const Paper& paper);

/// The ruler of 100 mm, what to do with it, and a line about the page.
void draw_foot(Svg& svg, const Paper& paper, std::string_view text);

/// Paper in white: a PDF shown on a dark screen has black letters, too.
Svg empty_page(const Paper& paper, std::string_view title, std::string_view description);

/// An arrow with a filled head.
void draw_arrow(Svg& svg, PagePoint from, PagePoint to, double width);

/// 0.1 as "100", 0.0225 as "22.5": metres as millimetres without needless decimals.
std::string printed_mm(double metres);

}  // namespace swarmsmith
