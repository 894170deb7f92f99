#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/drawing/svg.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// Shapes of a picture that is written as SVG and as TikZ alike. Lengths are mm.

struct SketchLine {
  std::vector<PagePoint> points;
  Paint paint;
};

struct SketchPolygon {
  std::vector<PagePoint> corners;
  Paint paint;
};

struct SketchCircle {
  PagePoint centre;
  double radius = 0;
  Paint paint;
};

struct SketchText {
  PagePoint at;  ///< on the base line
  std::string text;
  TextStyle style;
};

using SketchShape = std::variant<SketchLine, SketchPolygon, SketchCircle, SketchText>;

struct Sketch {
  double width = 0;
  double height = 0;
  std::vector<SketchShape> shapes;  ///< later ones on top
  /// For each state, the first of its shapes and the one behind its last: in order, apart.
  std::vector<std::pair<std::size_t, std::size_t>> states;

  /// A rectangle.
  void box(PagePoint top_left, double wide, double high, const Paint& paint);
  /// Lines of a label, names darker than parameters.
  void label(const std::vector<LabelLine>& lines);
};

Svg svg_of(const Sketch& sketch, std::string_view title, std::string_view description);
std::string tikz_of(const Sketch& sketch);

}  // namespace swarmsmith
