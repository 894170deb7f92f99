#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// A laid out machine as text, the same words and, but for DOT, the same places in each form.
/// Colours and, for prints without them, dashes follow the transition's source.

/// A picture; `title` is what a screen reader says and nothing visible. Each state is a part named
/// `data-state`, so that a page can light up what acts.
Svg drawing_of(const MachineLayout& layout, std::string_view title);
/// The same as a file of SVG.
std::string svg_of(const MachineLayout& layout, std::string_view title);

/// A `tikzpicture` for a document that has loaded TikZ, without further libraries; 1 mm is 1 mm.
/// It can be read with \input. Fonts are the document's sans serif.
std::string tikz_of(const MachineLayout& layout);

/// For Graphviz: states are nodes, and so are conditions. Places are Graphviz' own.
std::string dot_of(const MachineLayout& layout, std::string_view title);

}  // namespace swarmsmith
