#include "base/text/json.h"

#include <array>
#include <charconv>
#include <cmath>

#include "base/shown_text.h"

namespace swarmsmith {

std::string json_text(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t size = character_length(text);
    const char letter = text.front();
    const auto code = static_cast<unsigned char>(letter);
    if (size != 1) {
      // Bytes that are not UTF-8 (file names may have any bytes) are replaced, since JSON is UTF-8.
      quoted += size == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, size);
      text.remove_prefix(size == 0 ? 1 : size);
      continue;
    }
    text.remove_prefix(1);
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (letter == '\n') {
      quoted += "\\n";
    } else if (letter == '\t') {
      quoted += "\\t";
    } else if (code < 0x20) {
      quoted += "\\u00";
      quoted += kDigits[code >> 4U];
      quoted += kDigits[code & 15U];
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace swarmsmith
