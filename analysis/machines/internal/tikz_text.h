#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Words of TikZ that all pictures of controllers share.

/// "{rgb,255:red,0;green,114;blue,178}": a colour without a name of its own in the document.
std::string tikz_color(std::string_view color);

/// "(1.50,20.00)", mm.
std::string tikz_point(PagePoint point);

/// Strokes and gaps as an option: ",dash pattern=on 2mm off 0.8mm"; nothing for a full line.
std::string tikz_dashes(std::string_view dashes);

/// A line of text on its base line; `color` may be empty.
std::string tikz_label(PagePoint at, std::string_view text, double size, std::string_view color,
                       TextStyle::Anchor anchor = TextStyle::Anchor::Middle);

}  // namespace swarmsmith
