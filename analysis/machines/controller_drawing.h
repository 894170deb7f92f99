#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"
#include "sim/control/controller.h"

namespace swarmsmith {

/// A controller's picture in all its forms. A machine is drawn as states and conditions, a tree as
/// a tree of the same shapes, a network as a table of its weights with a colour each.
struct ControllerDrawing {
  Svg svg;
  std::string tikz;
  std::string dot;  ///< places are Graphviz' own; a network's inputs and wheels are nodes there
};

/// `title` is what a screen reader says and nothing visible. States of a machine and actions of a
/// tree are parts named `data-state`, numbered as `ControlSoftware::state` is. The height follows
/// from the width.
///
/// Throws std::invalid_argument when a module is none of the flavour's, a machine or tree is not as
/// it must be (`lay_out`), or the page is narrower than `kNarrowestMachine_mm`.
ControllerDrawing drawing_of(const Controller& controller, const Flavour& flavour, double width_mm,
                             std::string_view title);

/// What a reader of the picture needs to know, a sentence.
std::string_view explanation_of(Architecture architecture);

}  // namespace swarmsmith
