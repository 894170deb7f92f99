#include "sim/mission/colors.h"

#include <charconv>
#include <cstdint>
#include <system_error>

namespace swarmsmith {

std::optional<Rgb> color_from_name(std::string_view name) {
  for (const NamedColor& named : kNamedColors) {
    if (named.name == name) return named.color;
  }
  return std::nullopt;
}

/// Names are tried first: no name begins with #.
std::optional<Rgb> parse_color(std::string_view text) {
  if (text == "grey") return parse_color("gray");
  if (const auto named = color_from_name(text)) return named;
  std::uint32_t bits = 0;
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, bits, 16);
  if (error != std::errc() || stop != end) return std::nullopt;
  return Rgb{static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 8U),
             static_cast<std::uint8_t>(bits)};
}

std::string color_text(Rgb color) {
  for (const NamedColor& named : kNamedColors) {
    if (named.color == color) return std::string(named.name);
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : {color.r, color.g, color.b}) {
    text += kDigits[channel >> 4U];
    text += kDigits[channel & 15U];
  }
  return text;
}

}  // namespace swarmsmith
