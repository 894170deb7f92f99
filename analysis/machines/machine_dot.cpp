#include <fmt/format.h>

#include "analysis/machines/internal/dot_text.h"
#include "analysis/machines/internal/machine_colors.h"
#include "analysis/machines/machine_drawing.h"

namespace swarmsmith {
std::string dot_of(const MachineLayout& layout, std::string_view title) {
  std::string text = "digraph " + dot_text(title) + " {\n";
  text += "  node [fontname=\"Helvetica\", fontsize=10];\n  edge [arrowsize=0.7];\n";
  for (std::size_t i = 0; i < layout.states.size(); ++i) {
    text +=
        fmt::format("  s{} [shape={}, style=filled, color=\"{}\", fillcolor=\"{}\", label={}];\n",
                    i, layout.states[i].initial ? "doublecircle" : "circle", color_of(layout, i),
                    fill_of(layout, i), dot_label(layout.states[i].lines));
  }
  for (std::size_t i = 0; i < layout.conditions.size(); ++i) {
    const ConditionShape& shape = layout.conditions[i];
    const std::string color = color_of(layout, shape.source);
    text += fmt::format("  c{} [shape=hexagon, margin=0, color=\"{}\", label={}];\n", i, color,
                        dot_label(shape.lines));
    text += fmt::format("  s{} -> c{} [color=\"{}\", arrowhead=none];\n", shape.source, i, color);
    text += fmt::format("  c{} -> s{} [color=\"{}\"];\n", i, shape.target, color);
  }
  return text + "}\n";
}

}  // namespace swarmsmith
