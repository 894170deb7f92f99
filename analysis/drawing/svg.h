#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A small writer of SVG for figures on paper: millimetres, text as text, no scripts, no style
/// sheets, no ids (so that one page can contain several pictures), and only shapes that every SVG
/// reader and LaTeX's converters support.

/// A point on the page, millimetres, x to the right and y DOWN from the upper left corner.
struct PagePoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const PagePoint&, const PagePoint&) = default;
};

/// A bar that extends right or down: the middle of its first edge, and its length.
enum class BarDirection { Right, Down };
struct PageBar {
  PagePoint start;
  double length = 0;
};

/// Colours and stroke of a shape. Colours are "#rrggbb" or "none".
struct Paint {
  std::string fill = "none";
  std::string stroke = "none";
  double width = 0;    ///< of the stroke, mm
  std::string dashes;  ///< lengths in mm, such as "0.8 0.6"; empty: solid
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

/// Colours that colour-blind readers can distinguish (Okabe and Ito 2008); the first ones are most
/// visible on light backgrounds. Numbers beyond the last colour start again.
inline constexpr std::size_t kDistinctColors = 7;
std::string distinct_color(std::size_t number);

/// Mixes the colour with white: 0 gives the colour itself, 1 gives white. `color` is "#rrggbb".
std::string lightened(const std::string& color, double towards_white);

/// The fonts of every picture, first choice first.
inline constexpr std::string_view kFigureFonts = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

/// Adds a font before these. Text widths were measured in DejaVu Sans, so a wider font may
/// overflow. Errors: BadInput if the text is not a font name.
Expected<std::string> with_font(std::string svg, std::string_view font);

/// The number of characters in a UTF-8 text.
std::size_t characters_in(std::string_view text);

/// A text's width in DejaVu Sans, mm. It is at least as wide as the other common sans-serif fonts.
double text_width(std::string_view text, double size);

/// The text; if it is wider than `width` mm, its end is replaced by an ellipsis.
std::string fitted_text(std::string_view text, double size, double width);

/// A picture built shape by shape; later shapes are on top.
class Svg {
 public:
  /// `title` and `description` are for screen readers.
  Svg(double width_mm, double height_mm, std::string_view title, std::string_view description);

  void circle(PagePoint centre, double radius, const Paint& paint);
  /// Filled circles, written as a single shape to keep the file short.
  void dots(std::span<const PagePoint> centres, double radius, std::string_view color);
  /// A closed polygon.
  void polygon(std::span<const PagePoint> corners, const Paint& paint);
  /// Fills everything on the page outside a closed polygon.
  void outside(std::span<const PagePoint> corners, const Paint& paint);
  /// An open line with round joints.
  void line(std::span<const PagePoint> points, const Paint& paint);
  /// A quadratic Bezier curve: it leaves `from` in the direction of `control` and arrives at `to`
  /// from the direction of `control`.
  void curve(PagePoint from, PagePoint control, PagePoint to, const Paint& paint);
  /// Many bars of one colour and thickness, written compactly as one shape: for the cells of
  /// matrices. Edges are not smoothed, so that neighbours touch without a seam. The file is
  /// shortest if the bars of a row follow each other.
  void bars(std::span<const PageBar> bars, double thickness, std::string_view color,
            BarDirection direction = BarDirection::Right);
  /// A PNG file, stretched over a rectangle with sharp pixels; `opacity` is in [0, 1].
  void image(PagePoint top_left, double width, double height, std::string_view png, double opacity);
  /// `at` is on the baseline.
  void text(PagePoint at, std::string_view text, const TextStyle& style);
  /// Groups the shapes that are drawn until `end_part`; a page finds the group by
  /// `data-NAME="number"`.
  void begin_part(std::string_view name, std::size_t number);
  void end_part();
  /// Adds all shapes of another picture, with its upper left corner at `at`.
  void add(const Svg& other, PagePoint at);

  double width() const { return width_; }
  double height() const { return height_; }

  /// The contents of the SVG file.
  std::string finish() const;

 private:
  void path(const std::string& data, const Paint& paint, std::string_view more);

  double width_;
  double height_;
  std::string head_;    ///< the beginning of the file, with title and description
  std::string shapes_;  ///< one element per line
};

/// Simplifies an open line: the points left out lie within `tolerance` of the new line (Douglas and
/// Peucker 1973). The ends are kept.
std::vector<PagePoint> simplified(std::span<const PagePoint> points, double tolerance);

/// Reads a length in millimetres from "84mm", "8.4 cm", "3.3in" or a plain number of millimetres;
/// negative if the text has another form.
double millimetres_from_text(std::string_view text);

}  // namespace swarmsmith
