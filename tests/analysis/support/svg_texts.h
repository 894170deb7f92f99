#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// A text of a drawing and the box around its letters, mm, y down.
struct TextBox {
  std::string text;
  double left = 0;
  double right = 0;
  double top = 0;
  double bottom = 0;
};

/// The texts of an SVG that `Svg` has written, as wide as DejaVu Sans makes them: the widest of the
/// fonts that figures ask for.
std::vector<TextBox> texts_of(std::string_view svg);

/// A sentence for each two texts that overlap, and for each that reaches over the page.
std::vector<std::string> text_problems(std::string_view svg);

/// A sentence for each coordinate of circles and paths that lies outside of the page.
std::vector<std::string> shape_problems(std::string_view svg);

/// How many dots `Svg::dots` has drawn.
std::size_t dots_in(std::string_view svg);

}  // namespace swarmsmith
