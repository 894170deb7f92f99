#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"
#include "sim/control/controller.h"

namespace swarmsmith {

/// A picture of a controller in all formats. A machine is drawn as states and conditions; a tree as
/// a tree of the same shapes; a network as a table of its weights, each with a colour.
struct ControllerDrawing {
  Svg svg;
  std::string tikz;
  std::string dot;  ///< Graphviz chooses the positions; a network's inputs and wheels become nodes
};

/// `title` is for screen readers and not visible. States of a machine and actions of a tree are
/// parts named `data-state`, numbered like `ControlSoftware::state`. The height follows from the
/// width.
///
/// Throws std::invalid_argument if a module does not belong to the flavour, a machine or tree is
/// not valid (`lay_out`), or the page is narrower than `kNarrowestMachine_mm`.
ControllerDrawing drawing_of(const Controller& controller, const Flavour& flavour, double width_mm,
                             std::string_view title);

/// One sentence that explains the picture to a reader.
std::string_view explanation_of(Architecture architecture);

}  // namespace swarmsmith
