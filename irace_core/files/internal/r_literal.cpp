#include "irace_core/files/internal/r_literal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <system_error>

namespace swarmsmith::r {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
int hexadecimal_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}
char at(std::string_view text, std::size_t i) {
  return i < text.size() ? text[i] : '\0';
}

/// Skips digits from `i` on, with at most one point among them.
std::size_t skip_digits(std::string_view text, std::size_t i, bool hexadecimal) {
  bool point = false;
  for (; i < text.size(); ++i) {
    const bool digit = hexadecimal ? hexadecimal_digit(text[i]) >= 0 : is_digit(text[i]);
    if (!digit && (text[i] != '.' || point)) break;
    point = point || text[i] == '.';
  }
  return i;
}

/// The end of an exponent that begins at `i` with `letter`; `i` if there is none.
std::size_t skip_exponent(std::string_view text, std::size_t i, char letter) {
  if ((at(text, i) | 0x20) != letter) return i;
  std::size_t end = i + 1;
  if (at(text, end) == '+' || at(text, end) == '-') ++end;
  if (!is_digit(at(text, end))) return i;
  while (is_digit(at(text, end)))
    ++end;
  return end;
}

/// R's value for a number outside the range of doubles: Inf, or 0 if it is too small.
double out_of_range(std::string_view text, char exponent_letter) {
  const std::size_t first = text.find_first_not_of("0.");
  const std::size_t point = std::min(text.find('.'), text.size());
  const auto letter = std::find_if(text.begin(), text.end(), [exponent_letter](char c) {
    return (c | 0x20) == exponent_letter;
  });
  if (letter != text.end() && std::find(letter, text.end(), '-') != text.end()) return 0;
  const bool has_exponent = letter != text.end();
  return first < point || has_exponent ? std::numeric_limits<double>::infinity() : 0;
}

double to_double(std::string_view text, bool hexadecimal) {
  double value = 0;
  const auto format = hexadecimal ? std::chars_format::hex : std::chars_format::general;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (read.ec == std::errc::result_out_of_range) {
    return out_of_range(text, hexadecimal ? 'p' : 'e');
  }
  return value;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto byte = [&text](std::uint32_t bits) { text += static_cast<char>(bits); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0U | (code >> 6U));
  } else {
    if (code < 0x10000) {
      byte(0xE0U | (code >> 12U));
    } else {
      byte(0xF0U | (code >> 18U));
      byte(0x80U | ((code >> 12U) & 0x3FU));
    }
    byte(0x80U | ((code >> 6U) & 0x3FU));
  }
  byte(0x80U | (code & 0x3FU));
}

/// Reads up to `most` digits of `base` from `i` on, and moves `i` past them.
std::uint32_t read_code(std::string_view text, std::size_t& i, std::uint32_t base, int most) {
  std::uint32_t code = 0;
  for (int n = 0; n < most; ++n, ++i) {
    const int digit = hexadecimal_digit(at(text, i));
    if (digit < 0 || static_cast<std::uint32_t>(digit) >= base) break;
    code = code * base + static_cast<std::uint32_t>(digit);
  }
  return code;
}

/// Appends the escape at `i` (its backslash) to `value`, and moves `i` past it.
Expected<void> read_escape(std::string_view text, std::size_t& i, std::string& value) {
  constexpr std::string_view kLetters = "abfnrtv0\\\"'` \n";
  constexpr std::string_view kMeanings = "\a\b\f\n\r\t\v";
  const std::string where = std::to_string(i);
  const char letter = at(text, i + 1);
  const std::size_t known = kLetters.find(letter);
  i += 2;
  if (known < kMeanings.size()) {
    value += kMeanings[known];
  } else if (letter == 'x' || letter == 'u' || letter == 'U' || (letter >= '0' && letter <= '7')) {
    const bool octal = is_digit(letter);
    const bool braces = letter != 'x' && !octal && at(text, i) == '{';
    if (octal) --i;
    if (braces) ++i;
    const std::size_t first = i;
    const int most = letter == 'x' ? 2 : octal ? 3 : letter == 'u' ? 4 : 8;
    const std::uint32_t code = read_code(text, i, octal ? 8 : 16, most);
    const bool closed = !braces || at(text, i) == '}';
    if (i == first || !closed || code == 0 || code > 0x10FFFF) {
      return bad_input(
          "the escape \\" + std::string(1, letter) + " needs the number of a character after it",
          where);
    }
    if (braces) ++i;
    if (octal || letter == 'x') {
      value += static_cast<char>(code);
    } else {
      append_utf8(value, code);
    }
  } else if (known != std::string_view::npos && letter != '\0') {
    value += letter;
  } else {
    return bad_input("found the unknown escape \\" + std::string(1, letter) +
                         " in a string; for a backslash write \\\\, in a path write /",
                     where);
  }
  return {};
}

}  // namespace

NumberLiteral read_number(std::string_view text) {
  if (!is_digit(at(text, 0)) && !(at(text, 0) == '.' && is_digit(at(text, 1)))) return {};
  const bool hexadecimal =
      at(text, 0) == '0' && (at(text, 1) | 0x20) == 'x' && hexadecimal_digit(at(text, 2)) >= 0;
  const std::size_t start = hexadecimal ? 2 : 0;
  std::size_t end = skip_digits(text, start, hexadecimal);
  end = skip_exponent(text, end, hexadecimal ? 'p' : 'e');
  NumberLiteral literal{{to_double(text.substr(start, end - start), hexadecimal), false}, end};
  if (at(text, end) == 'L') {
    constexpr double kLargest = 2147483647;  // R reads larger ones as reals, with a warning
    const double value = literal.number.value;
    literal.number.is_integer = value == std::floor(value) && value <= kLargest;
    ++literal.bytes;
  }
  return literal;
}

Expected<TextLiteral> read_text(std::string_view text) {
  TextLiteral literal;
  std::size_t i = 1;
  while (i < text.size() && text[i] != text[0]) {
    if (text[i] == '\0') return bad_input("found a zero byte in a string", std::to_string(i));
    if (text[i] != '\\') {
      literal.value += text[i++];
    } else if (i + 1 == text.size()) {
      break;
    } else if (auto read = read_escape(text, i, literal.value); !read) {
      return Unexpected(read.error());
    }
  }
  if (i >= text.size()) {
    return bad_input("this string is not closed: expected " + std::string(1, text[0]), "0");
  }
  literal.bytes = i + 1;
  return literal;
}

std::optional<Expected<TextLiteral>> read_raw_text(std::string_view text) {
  if ((at(text, 0) | 0x20) != 'r' || (at(text, 1) != '"' && at(text, 1) != '\''))
    return std::nullopt;
  std::size_t begin = 2;
  while (at(text, begin) == '-')
    ++begin;
  constexpr std::string_view kOpen = "([{";
  const std::size_t kind = begin < text.size() ? kOpen.find(text[begin]) : std::string_view::npos;
  if (kind == std::string_view::npos) return std::nullopt;
  const std::string close = std::string(1, ")]}"[kind]) + std::string(begin - 2, '-') + text[1];
  const std::size_t end = text.find(close, begin + 1);
  using Result = Expected<TextLiteral>;
  if (end == std::string_view::npos)
    return Result(bad_input("this string is not closed: expected " + close, "0"));
  const std::string_view value = text.substr(begin + 1, end - begin - 1);
  if (value.find('\0') != std::string_view::npos)
    return Result(bad_input("found a zero byte in a string", "0"));
  return Result(TextLiteral{std::string(value), end + close.size()});
}

bool is_typographic(std::string_view character) {
  return character == "\u00a0" || character == "\ufeff" || character.substr(0, 2) == "\xe2\x80";
}

std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length > text.size()) return 1;
  const bool whole =
      std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                  [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; });
  return whole ? length : 1;
}

}  // namespace swarmsmith::r
