#include "analysis/machines/internal/tikz_text.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace swarmsmith {
namespace {

constexpr double kPointsPerMm = 72.27 / 25.4;  ///< points of TeX
constexpr double kFontSize_pt = 10;

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
    text.replace(at, from.size(), to), at += to.size();
}

/// Labels contain letters, digits, `_` in names, signs of numbers and the Greek letters of
/// parameters; labels of trees and networks also contain an arrow and degree signs.
std::string tex_text(std::string text) {
  replace_all(text, "_", "\\_");
  replace_all(text, "τ", "$\\tau$");
  replace_all(text, "α", "$\\alpha$");
  replace_all(text, "β", "$\\beta$");
  replace_all(text, "ξ", "$\\xi$");
  replace_all(text, "η", "$\\eta$");
  replace_all(text, "ρ", "$\\rho$");
  replace_all(text, "μ", "$\\mu$");
  replace_all(text, "→", "$\\rightarrow$");
  replace_all(text, "°", "$^\\circ$");
  return text;
}

std::string_view name_of(TextStyle::Anchor anchor) {
  switch (anchor) {
    case TextStyle::Anchor::Start:
      return "base west";
    case TextStyle::Anchor::End:
      return "base east";
    case TextStyle::Anchor::Middle:
      break;
  }
  return "base";
}

}  // namespace

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

std::string tikz_label(PagePoint at, std::string_view text, double size, std::string_view color,
                       TextStyle::Anchor anchor) {
  // Always ten points, scaled: every LaTeX font has this size, while other sizes may be replaced by
  // similar ones.
  return fmt::format(
      "\\node[anchor={},inner sep=0pt,outer sep=0pt,scale={:.3f},{}"
      "font=\\sffamily\\fontsize{{10}}{{12}}\\selectfont] at {} {{{}}};\n",
      name_of(anchor), size * kPointsPerMm / kFontSize_pt,
      color.empty() ? "" : "text=" + tikz_color(color) + ",", tikz_point(at),
      tex_text(std::string(text)));
}

}  // namespace swarmsmith
