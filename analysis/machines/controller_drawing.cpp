#include "analysis/machines/controller_drawing.h"

#include "analysis/machines/internal/network_drawing.h"
#include "analysis/machines/internal/tree_drawing.h"
#include "analysis/machines/machine_drawing.h"

namespace swarmsmith {
namespace {

/// Draws any kind of controller.
struct Drawer {
  const Flavour* flavour;
  double width;
  std::string_view title;

  ControllerDrawing operator()(const Machine& machine) const {
    const MachineLayout layout = lay_out(machine, *flavour, width);
    return {drawing_of(layout, title), tikz_of(layout), dot_of(layout, title)};
  }
  ControllerDrawing operator()(const Tree& tree) const {
    const TreeLayout layout = lay_out(tree, *flavour, width);
    const Sketch sketch = sketch_of(layout);
    return {svg_of(sketch, title, explanation_of(Architecture::Tree)), tikz_of(sketch),
            dot_of(layout, title)};
  }
  ControllerDrawing operator()(const Network& network) const {
    const Sketch sketch = sketch_of(network, width);
    return {svg_of(sketch, title, explanation_of(Architecture::Network)), tikz_of(sketch),
            dot_of(network, title)};
  }
};

}  // namespace

ControllerDrawing drawing_of(const Controller& controller, const Flavour& flavour, double width_mm,
                             std::string_view title) {
  return std::visit(Drawer{&flavour, width_mm, title}, controller);
}

std::string_view explanation_of(Architecture architecture) {
  switch (architecture) {
    case Architecture::Machine:
      return "Probabilistic finite state machine: circles are behaviours, the double one is the "
             "initial state; pointed boxes are conditions";
    case Architecture::Tree:
      return "Behaviour tree: the root is a sequence with memory, each ? a selector; an action, in "
             "a circle, acts until the condition beside or above it holds, then the next subtree "
             "is next";
    case Architecture::Network:
      break;
  }
  return "Neural network: the weight of each input, in rows, for each wheel, in columns";
}

}  // namespace swarmsmith
