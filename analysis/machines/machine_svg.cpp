#include "analysis/drawing/figure_style.h"
#include "analysis/machines/internal/machine_colors.h"
#include "analysis/machines/machine_drawing.h"

namespace swarmsmith {
namespace {

void draw_lines(Svg& svg, const std::vector<LabelLine>& lines, bool grey) {
  for (const LabelLine& line : lines) {
    const std::string_view ink = line.is_name ? "#000000" : "#333333";
    svg.text(line.at, line.text,
             {.size = line.size,
              .anchor = TextStyle::Anchor::Middle,
              .fill = std::string(grey ? kGreyText : ink)});
  }
}

}  // namespace

Svg drawing_of(const MachineLayout& layout, std::string_view title) {
  Svg svg(
      layout.width, layout.height, title,
      "Probabilistic finite state machine: circles are behaviours, the double one is the initial "
      "state; pointed boxes are conditions");
  // All curves are below all boxes, so that a box may hide a curve, but a curve never covers a
  // text.
  for (const ConditionShape& shape : layout.conditions) {
    Paint paint = stroked(color_of(layout, shape.source), kEdgeWidth);
    paint.dashes = state_dashes(shape.source);
    svg.curve(shape.curve[0], shape.curve[1], shape.curve[2], paint);
    svg.polygon(shape.head, filled(color_of(layout, shape.source)));
  }
  for (std::size_t i = 0; i < layout.states.size(); ++i) {
    const StateShape& shape = layout.states[i];
    Paint paint = stroked(color_of(layout, i), kStateWidth);
    paint.fill = fill_of(layout, i);
    svg.begin_part("state", i);
    svg.circle(shape.centre, shape.radius, paint);
    if (shape.initial) svg.circle(shape.centre, shape.radius - kInitialRing, paint);
    draw_lines(svg, shape.lines, !shape.reachable);
    svg.end_part();
  }
  for (const ConditionShape& shape : layout.conditions) {
    Paint paint = stroked(color_of(layout, shape.source), kEdgeWidth);
    paint.fill = kPaper;
    svg.polygon(corners_of(shape), paint);
    draw_lines(svg, shape.lines, !layout.states[shape.source].reachable);
  }
  draw_lines(svg, layout.notes, true);
  return svg;
}

std::string svg_of(const MachineLayout& layout, std::string_view title) {
  return drawing_of(layout, title).finish();
}

}  // namespace swarmsmith
