#pragma once

#include <string_view>

#include "analysis/drawing/svg.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// The common parts of printed sheets: margins inside which printers can print, and a foot with a
/// ruler to check the scale, because printers often scale pages. Lengths are in mm.
inline constexpr double kPageMargin = 8;
inline constexpr double kFootHeight = 8;

/// The largest area above the foot.
struct PrintedArea {
  double left = kPageMargin;
  double top = kPageMargin;
  double width = 0;
  double height = 0;
};
PrintedArea printed_area(const Paper& paper);

/// Draws a ruler of 100 mm with an instruction, and a line about the page.
void draw_foot(Svg& svg, const Paper& paper, std::string_view text);

/// A page with a white background, so that the black text of a PDF is readable on a dark screen,
/// too.
Svg empty_page(const Paper& paper, std::string_view title, std::string_view description);

/// An arrow with a filled head.
void draw_arrow(Svg& svg, PagePoint from, PagePoint to, double width);

/// Metres as millimetres without unnecessary decimals: 0.1 as "100", 0.0225 as "22.5".
std::string printed_mm(double metres);

}  // namespace swarmsmith
