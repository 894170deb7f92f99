#include <charconv>

#include <fmt/format.h>

#include "analysis/machines/internal/machine_colors.h"
#include "analysis/machines/machine_drawing.h"

namespace swarmsmith {
namespace {

constexpr double kPointsPerMm = 72.27 / 25.4;  ///< TeX's points
constexpr double kFontSize_pt = 10;

/// "{rgb,255:red,0;green,114;blue,178}": a colour without a name of its own in the document.
std::string tikz_color(std::string_view color) {
  int channel[3] = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const char* digits = color.data() + 1 + 2 * i;
    std::from_chars(digits, digits + 2, channel[i], 16);
  }
  return fmt::format("{{rgb,255:red,{};green,{};blue,{}}}", channel[0], channel[1], channel[2]);
}

std::string tikz_point(PagePoint point) {
  return fmt::format("({:.2f},{:.2f})", point.x, point.y);
}

/// Strokes and gaps as TikZ says them.
std::string tikz_dashes(std::string_view dashes) {
  if (dashes.empty()) return "";
  std::string text = ",dash pattern=";
  bool on = true;
  while (!dashes.empty()) {
    const std::size_t end = std::min(dashes.find(' '), dashes.size());
    text += fmt::format("{} {}mm ", on ? "on" : "off", dashes.substr(0, end));
    dashes.remove_prefix(std::min(end + 1, dashes.size()));
    on = !on;
  }
  text.pop_back();
  return text;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
    text.replace(at, from.size(), to), at += to.size();
}

/// Labels hold letters, digits, signs of numbers and the thesis' five Greek letters.
std::string tex_text(std::string text) {
  replace_all(text, "τ", "$\\tau$");
  replace_all(text, "α", "$\\alpha$");
  replace_all(text, "β", "$\\beta$");
  replace_all(text, "ξ", "$\\xi$");
  replace_all(text, "η", "$\\eta$");
  return text;
}

std::string tikz_lines(const std::vector<LabelLine>& lines, bool grey) {
  std::string text;
  for (const LabelLine& line : lines) {
    // Ten points, scaled: every font of LaTeX has them, while other sizes may be replaced by near
    // ones.
    text += fmt::format(
        "\\node[anchor=base,inner sep=0pt,outer sep=0pt,scale={:.3f},{}"
        "font=\\sffamily\\fontsize{{10}}{{12}}\\selectfont] at {} {{{}}};\n",
        line.size * kPointsPerMm / kFontSize_pt, grey ? "text=" + tikz_color(kGreyText) + "," : "",
        tikz_point(line.at), tex_text(line.text));
  }
  return text;
}

std::string tikz_edge(const MachineLayout& layout, const ConditionShape& shape) {
  const auto [begin, control, end] = shape.curve;
  // The cubic curve that is the quadratic one.
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
  // The page's y goes down, TikZ' up.
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
