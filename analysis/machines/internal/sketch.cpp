#include "analysis/machines/internal/sketch.h"

#include <fmt/format.h>

#include "analysis/machines/internal/tikz_text.h"

namespace swarmsmith {
namespace {

/// Adds shapes to an SVG.
struct SvgPen {
  Svg* svg;

  void operator()(const SketchLine& shape) const { svg->line(shape.points, shape.paint); }
  void operator()(const SketchPolygon& shape) const { svg->polygon(shape.corners, shape.paint); }
  void operator()(const SketchCircle& shape) const {
    svg->circle(shape.centre, shape.radius, shape.paint);
  }
  void operator()(const SketchText& shape) const { svg->text(shape.at, shape.text, shape.style); }
};

/// Options for \draw.
std::string tikz_paint(const Paint& paint) {
  const auto color = [](std::string_view key, const std::string& value) {
    return value == "none" ? std::string() : fmt::format("{}={},", key, tikz_color(value));
  };
  return fmt::format("{}{}line width={}mm{}", color("draw", paint.stroke),
                     color("fill", paint.fill), paint.width, tikz_dashes(paint.dashes));
}

std::string joined(const std::vector<PagePoint>& points) {
  std::string text;
  for (const PagePoint point : points)
    text += (text.empty() ? "" : " -- ") + tikz_point(point);
  return text;
}

struct TikzPen {
  std::string operator()(const SketchLine& shape) const {
    return fmt::format("\\draw[{}] {};\n", tikz_paint(shape.paint), joined(shape.points));
  }
  std::string operator()(const SketchPolygon& shape) const {
    return fmt::format("\\path[{}] {} -- cycle;\n", tikz_paint(shape.paint), joined(shape.corners));
  }
  std::string operator()(const SketchCircle& shape) const {
    return fmt::format("\\path[{}] {} circle[radius={:.2f}mm];\n", tikz_paint(shape.paint),
                       tikz_point(shape.centre), shape.radius);
  }
  std::string operator()(const SketchText& shape) const {
    return tikz_label(shape.at, shape.text, shape.style.size, shape.style.fill, shape.style.anchor);
  }
};

}  // namespace

void Sketch::box(PagePoint top_left, double wide, double high, const Paint& paint) {
  const auto [x, y] = top_left;
  shapes.emplace_back(
      SketchPolygon{{top_left, {x + wide, y}, {x + wide, y + high}, {x, y + high}}, paint});
}

void Sketch::label(const std::vector<LabelLine>& lines) {
  for (const LabelLine& line : lines) {
    shapes.emplace_back(SketchText{line.at,
                                   line.text,
                                   {.size = line.size,
                                    .anchor = TextStyle::Anchor::Middle,
                                    .fill = line.is_name ? "#000000" : "#333333"}});
  }
}

Svg svg_of(const Sketch& sketch, std::string_view title, std::string_view description) {
  Svg svg(sketch.width, sketch.height, title, description);
  std::size_t state = 0;
  for (std::size_t i = 0; i < sketch.shapes.size(); ++i) {
    const bool is_part = state < sketch.states.size();
    if (is_part && i == sketch.states[state].first) svg.begin_part("state", state);
    std::visit(SvgPen{&svg}, sketch.shapes[i]);
    if (is_part && i + 1 == sketch.states[state].second) {
      svg.end_part();
      ++state;
    }
  }
  return svg;
}

std::string tikz_of(const Sketch& sketch) {
  // On the page y goes down, in TikZ it goes up.
  std::string text = "\\begin{tikzpicture}[x=1mm,y=-1mm]\n";
  text += fmt::format("\\useasboundingbox (0,0) rectangle ({:.2f},{:.2f});\n", sketch.width,
                      sketch.height);
  for (const SketchShape& shape : sketch.shapes)
    text += std::visit(TikzPen{}, shape);
  return text + "\\end{tikzpicture}\n";
}

}  // namespace swarmsmith
