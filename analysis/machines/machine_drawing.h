#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// A machine with a layout, written in several formats with the same texts and, except in DOT, the
/// same positions. A transition has the colour of its source state, and the same dashes for prints
/// without colours.

/// The picture. `title` is for screen readers and not visible. Each state is a part named
/// `data-state`, so that a page can highlight the active state.
Svg drawing_of(const MachineLayout& layout, std::string_view title);
/// The picture as an SVG file.
std::string svg_of(const MachineLayout& layout, std::string_view title);

/// A `tikzpicture` for a document that has loaded TikZ; needs no other libraries; 1 mm is 1 mm. Can
/// be included with \input. Uses the document's sans-serif font.
std::string tikz_of(const MachineLayout& layout);

/// For Graphviz: states and conditions are nodes. Graphviz chooses the positions.
std::string dot_of(const MachineLayout& layout, std::string_view title);

}  // namespace swarmsmith
