#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "base/assert.h"
#include "irace_core/expression.h"

namespace swarmsmith {
namespace {

/// The parts of a decimal number: 0.d1d2d3... * 10^point, without trailing zeros.
struct Decimal {
  std::string digits;
  int point = 0;
  bool negative = false;
};

/// The shortest digits, at most 15, that show `value` to 15 significant digits.
Decimal to_decimal(double value) {
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::fabs(value),
                                 std::chars_format::scientific, 14);
  SWARMSMITH_ASSERT(end.ec == std::errc{}, "a number in scientific notation fits 40 characters");
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  const std::size_t exponent_at = text.find('e');
  Decimal decimal;
  decimal.negative = std::signbit(value);
  for (const char c : text.substr(0, exponent_at)) {
    if (c != '.') decimal.digits += c;
  }
  while (decimal.digits.size() > 1 && decimal.digits.back() == '0')
    decimal.digits.pop_back();
  decimal.point = std::atoi(std::string(text.substr(exponent_at + 1)).c_str()) + 1;
  return decimal;
}

/// Fixed notation with as many decimals as 15 significant digits need. Whole numbers show all their
/// digits, also after the fifteenth.
std::string fixed(double value, const Decimal& decimal) {
  std::array<char, 800> buffer{};  // 309 digits before the point, 324 + 15 after it
  const int decimals = std::max(0, static_cast<int>(decimal.digits.size()) - decimal.point);
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  SWARMSMITH_ASSERT(end.ec == std::errc{}, "a number in fixed notation fits 800 characters");
  return {buffer.data(), end.ptr};
}

std::string scientific(const Decimal& decimal) {
  const int exponent = decimal.point - 1;
  const std::string exponent_digits = std::to_string(std::abs(exponent));
  std::string text = decimal.negative ? "-" : "";
  text += decimal.digits.substr(0, 1);
  if (decimal.digits.size() > 1) text += '.';
  text += decimal.digits.substr(1);
  text += exponent < 0 ? "e-" : "e+";
  if (exponent_digits.size() < 2) text += '0';
  text += exponent_digits;
  return text;
}

/// Sorting key of one character: its class, then the letter without regard to case.
int collation_key(char c) {
  const auto code = static_cast<unsigned char>(c);
  if (c >= '0' && c <= '9') return 1000 + code;
  if (c >= 'a' && c <= 'z') return 2000 + code;
  if (c >= 'A' && c <= 'Z') return 2000 + code + ('a' - 'A');
  return code >= 128 ? 3000 + code : code;
}

}  // namespace

int compare_texts(std::string_view a, std::string_view b) {
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    const int difference = collation_key(a[i]) - collation_key(b[i]);
    if (difference != 0) return difference;
  }
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = 0; i < common; ++i) {
    if (a[i] != b[i]) return a[i] > b[i] ? -1 : 1;  // lower case has the larger code
  }
  return 0;
}

std::string to_text(const Scalar& value) {
  if (value.missing) return "NA";
  switch (value.type) {
    case Scalar::Type::Text:
      return value.text;
    case Scalar::Type::Logical:
      return value.number != 0 ? "TRUE" : "FALSE";
    case Scalar::Type::Integer:
      return to_fixed_text(value.number);
    case Scalar::Type::Real:
      break;
  }
  if (value.number == 0) return "0";
  if (std::isinf(value.number)) return value.number < 0 ? "-Inf" : "Inf";
  const Decimal decimal = to_decimal(value.number);
  std::string plain = fixed(value.number, decimal);
  std::string powers = scientific(decimal);
  return plain.size() <= powers.size() ? plain : powers;
}

std::string to_fixed_text(double value) {
  return value == 0 ? "0" : fixed(value, to_decimal(value));
}

std::string exact_text(double value) {
  std::array<char, 800> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                 value == 0 ? 0 : value, std::chars_format::fixed);
  SWARMSMITH_ASSERT(end.ec == std::errc{}, "a number in fixed notation fits 800 characters");
  return {buffer.data(), end.ptr};
}

}  // namespace swarmsmith
