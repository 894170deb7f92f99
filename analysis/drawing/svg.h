#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A small writer of SVG for figures on paper: millimetres, text as text, no scripts, no style
/// sheets, no ids (so that several pictures can stand in one page), the shapes that every reader of
/// SVG and LaTeX's converters know.

/// A place on the page, millimetres, x to the right and y DOWN from the upper left corner.
struct PagePoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const PagePoint&, const PagePoint&) = default;
};

/// A bar that goes right or down: the middle of its first edge, and its length.
enum class BarDirection { Right, Down };
struct PageBar {
  PagePoint start;
  double length = 0;
};

/// How a shape is painted. Colours are "#rrggbb" or "none".
struct Paint {
  std::string fill = "none";
  std::string stroke = "none";
  double width = 0;    ///< of the stroke, mm
  std::string dashes;  ///< lengths in mm, such as "0.8 0.6"; empty: none
};

Paint filled(std::string_view color);
Paint stroked(std::string_view color, double width);

struct TextStyle {
  enum class Anchor { Start, Middle, End };
  double size = 2.8;  ///< mm: 2.8 mm are 8 points
  Anchor anchor = Anchor::Start;
  bool bold = false;
  std::string fill = "#000000";
};

/// Colours that colour-blind readers tell apart (Okabe and Ito 2008), those first that are well
/// seen on light grounds; numbers beyond the last begin again.
inline constexpr std::size_t kDistinctColors = 7;
std::string distinct_color(std::size_t number);

/// The colour part of the way to white: 0 gives itself, 1 white. `color` is "#rrggbb".
std::string lightened(const std::string& color, double towards_white);

/// The fonts that every picture asks for, first choice first.
inline constexpr std::string_view kFigureFonts = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

/// The picture with a font of one's own before these. Widths were measured in DejaVu Sans; a wider
/// font may run over. Errors: BadInput for what is not a font's name.
Expected<std::string> with_font(std::string svg, std::string_view font);

/// Characters of a UTF-8 text.
std::size_t characters_in(std::string_view text);

/// A text's width in DejaVu Sans, which is at least that in the other common sans-serif fonts, mm.
double text_width(std::string_view text, double size);

/// The text, with its end replaced by an ellipsis when it is wider than `width` mm.
std::string fitted_text(std::string_view text, double size, double width);

/// A picture that grows shape by shape, later ones on top.
class Svg {
 public:
  /// `title` and `description` are what a screen reader says.
  Svg(double width_mm, double height_mm, std::string_view title, std::string_view description);

  void circle(PagePoint centre, double radius, const Paint& paint);
  /// Filled circles, short in the file: all of them are one shape.
  void dots(std::span<const PagePoint> centres, double radius, std::string_view color);
  /// Closed.
  void polygon(std::span<const PagePoint> corners, const Paint& paint);
  /// Everything of the page outside of a closed polygon.
  void outside(std::span<const PagePoint> corners, const Paint& paint);
  /// Open; round joints.
  void line(std::span<const PagePoint> points, const Paint& paint);
  /// A quadratic Bezier curve: it leaves `from` towards `control` and comes to `to` from there.
  void curve(PagePoint from, PagePoint control, PagePoint to, const Paint& paint);
  /// Many bars of one colour and thickness as one shape, in few letters each: cells of matrices.
  /// Edges are drawn crisp, so that neighbours touch without a seam. Shortest when bars of a row
  /// follow each other.
  void bars(std::span<const PageBar> bars, double thickness, std::string_view color,
            BarDirection direction = BarDirection::Right);
  /// The bytes of a PNG file, stretched over a rectangle, pixels left sharp; `opacity` in [0, 1].
  void image(PagePoint top_left, double width, double height, std::string_view png, double opacity);
  /// `at` is on the base line.
  void text(PagePoint at, std::string_view text, const TextStyle& style);
  /// What is drawn until `end_part` belongs together, and a page finds it as `data-NAME="number"`.
  void begin_part(std::string_view name, std::size_t number);
  void end_part();
  /// All shapes of another picture, its upper left corner at `at`.
  void add(const Svg& other, PagePoint at);

  double width() const { return width_; }
  double height() const { return height_; }

  /// The file.
  std::string finish() const;

 private:
  void path(const std::string& data, const Paint& paint, std::string_view more);

  double width_;
  double height_;
  std::string head_;    ///< the file's begin, with title and description
  std::string shapes_;  ///< an element a line
};

/// The points of an open line that matter: points left out lie within `tolerance` of those kept
/// (Douglas and Peucker 1973). Ends are kept.
std::vector<PagePoint> simplified(std::span<const PagePoint> points, double tolerance);

/// A length in millimetres from "84mm", "8.4 cm", "3.3in" or a bare number of millimetres; negative
/// when it is none of these.
double millimetres_from_text(std::string_view text);

}  // namespace swarmsmith
