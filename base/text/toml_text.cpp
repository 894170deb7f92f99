#include "base/text/toml_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace swarmsmith {

std::string text_of(const std::vector<Section>& sections) {
  std::string text;
  for (const Section& section : sections) {
    if (!section.header.empty()) text += "\n" + section.header + "\n";
    for (const SectionLine& line : section.lines)
      text += line.key + " = " + line.value + "\n";
  }
  return text;
}

std::string quoted_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') quoted += '\\';
    if (letter == '\n') {
      quoted += "\\n";
    } else if (code < 0x20 || code == 0x7f) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      quoted += "\\u00";
      quoted += {kDigits[code >> 4U], kDigits[code & 0xfU]};
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  char* const last = buffer.data() + buffer.size();
  const bool whole =
      std::abs(value) < 1e15 && value == std::floor(value) && !(value == 0 && std::signbit(value));
  const auto end = whole ? std::to_chars(buffer.data(), last, static_cast<std::int64_t>(value)).ptr
                         : std::to_chars(buffer.data(), last, value).ptr;
  std::string text(buffer.data(), end);
  // A real number in TOML needs a point or an exponent; -0 would be read back as the integer 0.
  return text == "-0" ? "-0.0" : text;
}

}  // namespace swarmsmith
