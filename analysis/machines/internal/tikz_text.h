#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Pieces of TikZ code for all pictures of controllers.

/// "{rgb,255:red,0;green,114;blue,178}": a colour that the document need not define.
std::string tikz_color(std::string_view color);

/// "(1.50,20.00)", mm.
std::string tikz_point(PagePoint point);

/// Dashes and gaps as an option: ",dash pattern=on 2mm off 0.8mm"; empty for a solid line.
std::string tikz_dashes(std::string_view dashes);

/// A line of text on its baseline; `color` may be empty.
std::string tikz_label(PagePoint at, std::string_view text, double size, std::string_view color,
                       TextStyle::Anchor anchor = TextStyle::Anchor::Middle);

}  // namespace swarmsmith
