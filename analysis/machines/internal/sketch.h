#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/drawing/svg.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// Shapes of a picture that can be written as SVG or as TikZ. Lengths are mm.

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
  PagePoint at;  ///< on the baseline
  std::string text;
  TextStyle style;
};

using SketchShape = std::variant<SketchLine, SketchPolygon, SketchCircle, SketchText>;

struct Sketch {
  double width = 0;
  double height = 0;
  std::vector<SketchShape> shapes;  ///< later shapes are on top
  /// For each state, the index of its first shape and the index after its last shape; in order,
  /// without overlaps.
  std::vector<std::pair<std::size_t, std::size_t>> states;

  /// A rectangle.
  void box(PagePoint top_left, double wide, double high, const Paint& paint);
  /// Lines of a label; names are darker than parameters.
  void label(const std::vector<LabelLine>& lines);
};

Svg svg_of(const Sketch& sketch, std::string_view title, std::string_view description);
std::string tikz_of(const Sketch& sketch);

}  // namespace swarmsmith
