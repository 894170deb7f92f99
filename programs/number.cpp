#include "programs/number.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool same_word(std::string_view text, std::string_view lower) {
  return std::ranges::equal(
      text, lower, [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9')
    ++end;
  return end - at;
}

/// The text has no sign. R reads "1e" and "1e+" as 1.
std::optional<double> parse_decimal(std::string_view text) {
  const std::size_t whole = digits_at(text, 0);
  std::size_t at = whole;
  std::size_t fraction = 0;
  if (at < text.size() && text[at] == '.') {
    fraction = digits_at(text, ++at);
    at += fraction;
  }
  if (whole + fraction == 0) return std::nullopt;
  std::size_t end = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t digits = digits_at(text, at);
    at += digits;
    if (digits > 0) end = at;
  }
  if (at != text.size()) return std::nullopt;
  double value = 0;
  const auto [last, error] = std::from_chars(text.data(), text.data() + end, value);
  if (error == std::errc()) return value;
  // If the number is too large or too small, the C library returns infinity or the nearest number.
  return std::strtod(std::string(text.substr(0, end)).c_str(), nullptr);
}

/// The text has no sign and no 0x.
std::optional<double> parse_hexadecimal(std::string_view text) {
  const std::size_t exponent = text.find_first_of("pP");
  const std::string_view digits = text.substr(0, exponent);
  const bool fine = digits.find_first_not_of("0123456789abcdefABCDEF.") == std::string_view::npos &&
                    digits.find_first_not_of('.') != std::string_view::npos &&
                    std::ranges::count(digits, '.') <= 1;
  if (!fine) return std::nullopt;
  if (exponent != std::string_view::npos) {
    std::string_view power = text.substr(exponent + 1);
    if (!power.empty() && (power[0] == '+' || power[0] == '-')) power.remove_prefix(1);
    if (digits_at(power, 0) != power.size()) return std::nullopt;
    if (power.empty()) text = digits;  // as in "1e"
  }
  return std::strtod(("0x" + std::string(text)).c_str(), nullptr);
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  bool negative = false;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
    negative = text[0] == '-';
    text.remove_prefix(1);
  }
  std::optional<double> value;
  if (text == "NA" || same_word(text, "nan")) return kNaN;
  if (same_word(text, "inf") || same_word(text, "infinity")) {
    value = kInfinity;
  } else if (text.starts_with("0x") || text.starts_with("0X")) {
    value = parse_hexadecimal(text.substr(2));
  } else {
    value = parse_decimal(text);
  }
  if (value && negative) *value = -*value;
  return value;
}

}  // namespace swarmsmith
