#include "analysis/machines/internal/tree_drawing.h"

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "analysis/machines/internal/dot_text.h"
#include "analysis/machines/internal/label_lines.h"
#include "analysis/machines/internal/machine_colors.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kSequenceWithMemory = "→*";
constexpr std::string_view kSelector = "?";

/// A square with its symbol.
void draw_node(Sketch& sketch, const TreeLayout& layout, PagePoint centre, std::string_view sign,
               std::string_view color) {
  const double side = layout.node_side;
  Paint paint = stroked(color, kStateWidth);
  paint.fill = kPaper;
  sketch.box({centre.x - side / 2, centre.y - side / 2}, side, side, paint);
  sketch.shapes.emplace_back(
      SketchText{{centre.x, centre.y + kMiddle * layout.sign_size},
                 std::string(sign),
                 {.size = layout.sign_size, .anchor = TextStyle::Anchor::Middle}});
}

void draw_edges(Sketch& sketch, const SubtreeShape& shape, std::size_t number) {
  sketch.shapes.emplace_back(SketchLine{shape.to_selector, stroked(kInk, kEdgeWidth)});
  Paint paint = stroked(state_color(number), kEdgeWidth);
  paint.dashes = state_dashes(number);
  sketch.shapes.emplace_back(SketchLine{shape.to_condition, paint});
  sketch.shapes.emplace_back(SketchLine{shape.to_action, paint});
}

void draw_leaves(Sketch& sketch, const SubtreeShape& shape, std::size_t number) {
  const LeafShape& box = shape.condition;
  Paint paint = stroked(state_color(number), kEdgeWidth);
  paint.fill = kPaper;
  const auto corners = pointed_box(box.centre, box.width, box.height);
  sketch.shapes.emplace_back(SketchPolygon{{corners.begin(), corners.end()}, paint});
  sketch.label(box.lines);
  paint = stroked(state_color(number), kStateWidth);
  paint.fill = state_fill(number);
  const std::size_t first = sketch.shapes.size();
  sketch.shapes.emplace_back(SketchCircle{shape.action.centre, shape.action.width / 2, paint});
  sketch.label(shape.action.lines);
  sketch.states.emplace_back(first, sketch.shapes.size());
}

}  // namespace

Sketch sketch_of(const TreeLayout& layout) {
  Sketch sketch{.width = layout.width, .height = layout.height, .shapes = {}, .states = {}};
  for (std::size_t i = 0; i < layout.subtrees.size(); ++i)
    draw_edges(sketch, layout.subtrees[i], i);
  draw_node(sketch, layout, layout.root, kSequenceWithMemory, kInk);
  for (std::size_t i = 0; i < layout.subtrees.size(); ++i) {
    draw_node(sketch, layout, layout.subtrees[i].selector, kSelector, state_color(i));
    draw_leaves(sketch, layout.subtrees[i], i);
  }
  return sketch;
}

std::string dot_of(const TreeLayout& layout, std::string_view title) {
  std::string text = "digraph " + dot_text(title) + " {\n  ordering=out;\n";
  text += "  node [fontname=\"Helvetica\", fontsize=10];\n  edge [arrowhead=none];\n";
  text += fmt::format("  root [shape=square, label=\"{}\"];\n", kSequenceWithMemory);
  for (std::size_t i = 0; i < layout.subtrees.size(); ++i) {
    const SubtreeShape& shape = layout.subtrees[i];
    const std::string color = state_color(i);
    text += fmt::format("  s{} [shape=square, color=\"{}\", label=\"{}\"];\n", i, color, kSelector);
    text += fmt::format("  c{} [shape=hexagon, margin=0, color=\"{}\", label={}];\n", i, color,
                        dot_label(shape.condition.lines));
    text += fmt::format(
        "  a{} [shape=circle, style=filled, color=\"{}\", fillcolor=\"{}\", label={}];\n", i, color,
        state_fill(i), dot_label(shape.action.lines));
    text += fmt::format("  root -> s{0};\n  s{0} -> c{0} [color=\"{1}\"];\n", i, color);
    text += fmt::format("  s{0} -> a{0} [color=\"{1}\"];\n", i, color);
  }
  return text + "}\n";
}

}  // namespace swarmsmith
