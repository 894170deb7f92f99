#include <fmt/format.h>

#include "analysis/machines/internal/machine_colors.h"
#include "analysis/machines/internal/tikz_text.h"
#include "analysis/machines/machine_drawing.h"

namespace swarmsmith {
namespace {

std::string tikz_lines(const std::vector<LabelLine>& lines, bool grey) {
  std::string text;
  for (const LabelLine& line : lines)
    text += tikz_label(line.at, line.text, line.size, grey ? kGreyText : "");
  return text;
}

std::string tikz_edge(const MachineLayout& layout, const ConditionShape& shape) {
  const auto [begin, control, end] = shape.curve;
  // Converts the quadratic curve to a cubic one.
  const auto towards = [control = control](PagePoint from) {
    return PagePoint{from.x + (control.x - from.x) * 2 / 3, from.y + (control.y - from.y) * 2 / 3};
  };
  const std::string color = tikz_color(color_of(layout, shape.source));
  return fmt::format("\\draw[draw={},line width={}mm{}] {} .. controls {} and {} .. {};\n", color,
                     kEdgeWidth, tikz_dashes(state_dashes(shape.source)), tikz_point(begin),
                     tikz_point(towards(begin)), tikz_point(towards(end)), tikz_point(end)) +
         fmt::format("\\fill[fill={}] {} -- {} -- {} -- cycle;\n", color, tikz_point(shape.head[0]),
                     tikz_point(shape.head[1]), tikz_point(shape.head[2]));
}

std::string tikz_state(const MachineLayout& layout, std::size_t number) {
  const StateShape& shape = layout.states[number];
  const auto circle = [&](double radius) {
    return fmt::format("\\draw[draw={},fill={},line width={}mm] {} circle[radius={:.2f}mm];\n",
                       tikz_color(color_of(layout, number)), tikz_color(fill_of(layout, number)),
                       kStateWidth, tikz_point(shape.centre), radius);
  };
  std::string text = circle(shape.radius);
  if (shape.initial) text += circle(shape.radius - kInitialRing);
  return text + tikz_lines(shape.lines, !shape.reachable);
}

std::string tikz_condition(const MachineLayout& layout, const ConditionShape& shape) {
  std::string text =
      fmt::format("\\draw[draw={},fill={},line width={}mm]",
                  tikz_color(color_of(layout, shape.source)), tikz_color(kPaper), kEdgeWidth);
  for (const PagePoint corner : corners_of(shape))
    text += " " + tikz_point(corner) + " --";
  return text + " cycle;\n" + tikz_lines(shape.lines, !layout.states[shape.source].reachable);
}

}  // namespace

std::string tikz_of(const MachineLayout& layout) {
  // On the page y goes down, in TikZ it goes up.
  std::string text = "\\begin{tikzpicture}[x=1mm,y=-1mm]\n";
  text += fmt::format("\\useasboundingbox (0,0) rectangle ({:.2f},{:.2f});\n", layout.width,
                      layout.height);
  for (const ConditionShape& shape : layout.conditions)
    text += tikz_edge(layout, shape);
  for (std::size_t i = 0; i < layout.states.size(); ++i)
    text += tikz_state(layout, i);
  for (const ConditionShape& shape : layout.conditions)
    text += tikz_condition(layout, shape);
  return text + tikz_lines(layout.notes, true) + "\\end{tikzpicture}\n";
}

}  // namespace swarmsmith
