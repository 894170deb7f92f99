#include "irace_core/files/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace swarmsmith {

std::optional<double> number_of(std::string_view text) {
  if (text.ends_with('L')) text.remove_suffix(1);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  auto format = std::chars_format::general;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    text.remove_prefix(2);
    format = std::chars_format::hex;
  }
  // The only letters are those of exponents and hexadecimal digits; "inf", "nan" and a second sign
  // are not numbers.
  if (text.empty() || text.front() == '-') return std::nullopt;
  double number = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number, format);
  if (error != std::errc() || end != text.end() || !std::isfinite(number)) return std::nullopt;
  return negative ? -number : number;
}

std::string shortest_text(double number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end};
}

std::string quoted_in_r(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

}  // namespace swarmsmith
