#include "base/shown_text.h"

#include <fmt/format.h>

namespace swarmsmith {
namespace {

unsigned code_of(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  switch (character.size()) {
    case 1:
      return byte(0);
    case 2:
      return (byte(0) & 0x1fU) << 6U | (byte(1) & 0x3fU);
    case 3:
      return (byte(0) & 0x0fU) << 12U | (byte(1) & 0x3fU) << 6U | (byte(2) & 0x3fU);
    default:
      return 0x10000U;  // all characters that need an escape are shorter
  }
}

bool is_control(unsigned code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

/// Marks of direction and embedding, and Unicode's two line ends.
bool turns_or_breaks(unsigned code) {
  return code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// Number of bytes at the beginning that are shown unchanged in any layout; most texts have only
/// these.
std::size_t plain_length(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() && text[length] >= ' ' && text[length] < '\x7f')
    ++length;
  return length;
}

}  // namespace

std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  const unsigned char second = byte(1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return overlong || beyond ? 0 : length;
}

std::string escape_of(std::string_view text, std::size_t length) {
  if (length == 0) return fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
  if (text.front() == '\n') return "\\n";
  if (text.front() == '\t') return "\\t";
  const unsigned code = code_of(text.substr(0, length));
  return is_control(code) || turns_or_breaks(code) ? fmt::format("\\u{:04x}", code) : "";
}

std::string as_shown(std::string_view text, Layout layout) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    std::size_t length = plain_length(text);
    if (length > 0) {
      shown += text.substr(0, length);
    } else if (layout == Layout::Kept && (text.front() == '\n' || text.front() == '\t')) {
      shown += text.front();
      length = 1;
    } else {
      length = character_length(text);
      const std::string escape = escape_of(text, length);
      shown += escape.empty() ? text.substr(0, length) : std::string_view(escape);
      if (length == 0) length = 1;
    }
    text.remove_prefix(length);
  }
  return shown;
}

}  // namespace swarmsmith
