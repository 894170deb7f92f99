#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "irace_core/files/expression_text.h"
#include "irace_core/files/internal/r_operators.h"

namespace swarmsmith {
namespace {

using Type = Scalar::Type;

/// The fewest digits from which the same number is read back, without an exponent where that is
/// short.
std::string shortest(double value) {
  if (std::isinf(value)) return value < 0 ? "-Inf" : "Inf";
  if (value == 0) return std::signbit(value) ? "-0" : "0";
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), end.ptr);
  if (text.find('e') == std::string::npos || std::fabs(value) < 1) return text;
  const std::string plain = to_fixed_text(value);
  double read = 0;
  std::from_chars(plain.data(), plain.data() + plain.size(), read);
  return plain.size() <= 12 && read == value ? plain : text;
}

std::string print_constant(const Scalar& value) {
  if (value.missing) {
    constexpr std::array<const char*, 4> kMissing = {"NA", "NA_integer_", "NA_real_",
                                                     "NA_character_"};
    return kMissing.at(static_cast<std::size_t>(value.type));
  }
  switch (value.type) {
    case Type::Logical:
      return value.number != 0 ? "TRUE" : "FALSE";
    case Type::Integer:
      return to_fixed_text(value.number) + "L";
    case Type::Real:
      return shortest(value.number);
    case Type::Text:
      break;
  }
  constexpr std::string_view kHexadecimal = "0123456789abcdef";
  std::string text = "\"";
  for (const char c : value.text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += std::string("\\") + c;
    } else if (code < 0x20 || code == 0x7F) {  // so that the text stays on one line
      text += std::string("\\x") + kHexadecimal[code / 16] + kHexadecimal[code % 16];
    } else {
      text += c;
    }
  }
  return text + "\"";
}

/// The name, in backticks where R would not read it as a name.
std::string print_name(const std::string& name) {
  constexpr std::array<std::string_view, 15> kReserved = {
      "TRUE", "FALSE", "NULL",   "NA",    "Inf",  "NaN", "function", "if",
      "else", "for",   "repeat", "while", "next", "in",  "break"};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool plain = !is_digit(name[0]) && name[0] != '_' &&
                     !(name[0] == '.' && name.size() > 1 && is_digit(name[1])) &&
                     std::find(kReserved.begin(), kReserved.end(), name) == kReserved.end();
  return plain ? name : "`" + name + "`";
}

int binding_of(const Expression& expression) {
  if (expression.operation() == Operation::Not) return irace::kBindingOfNot;
  if (expression.operation() == Operation::Negate) return irace::kBindingOfSign;
  if (expression.operation() == Operation::Constant) {
    const Scalar value = expression.evaluate({})[0];
    const bool signed_number = value.type != Type::Text && std::signbit(value.number);
    return signed_number && !value.missing ? irace::kBindingOfSign : irace::kBindingOfAtom;
  }
  const irace::Spelling* spelling = irace::find_spelling(expression.operation());
  return spelling == nullptr || spelling->binding == 0 ? irace::kBindingOfAtom : spelling->binding;
}

std::string print_at_least(const Expression& expression, int binding) {
  return binding_of(expression) >= binding ? print(expression) : "(" + print(expression) + ")";
}

std::string print_binary(const irace::Spelling& op, const Expression& left,
                         const Expression& right) {
  const bool is_power = op.binding == irace::kBindingOfPower;  // groups to the right
  const bool is_tight = is_power || op.operation == Operation::Range;
  const bool may_chain = !is_power && op.binding != irace::kBindingOfComparison;
  const std::string blank = is_tight ? "" : " ";
  return print_at_least(left, may_chain ? op.binding : op.binding + 1) + blank +
         std::string(op.text) + blank +
         print_at_least(right, is_power ? op.binding : op.binding + 1);
}

}  // namespace

std::string print(const Expression& expression) {
  const std::span<const Expression> operands = expression.operands();
  const Operation operation = expression.operation();
  if (operation == Operation::Constant) return print_constant(expression.evaluate({})[0]);
  if (operation == Operation::Parameter) return print_name(expression.name());
  if (operation == Operation::Not) {
    // These parentheses are not needed, but make expressions such as !a == b easier to read.
    const bool plain = binding_of(operands[0]) == irace::kBindingOfAtom ||
                       operands[0].operation() == Operation::Not;
    return plain ? "!" + print(operands[0]) : "!(" + print(operands[0]) + ")";
  }
  if (operation == Operation::Negate) {
    return "-" + print_at_least(operands[0], irace::kBindingOfSign);
  }
  const irace::Spelling& spelling = *irace::find_spelling(operation);
  if (spelling.binding > 0) return print_binary(spelling, operands[0], operands[1]);
  std::string text = std::string(spelling.text) + "(";
  for (const Expression& operand : operands) {
    if (&operand != operands.data()) text += ", ";
    text += print(operand);
  }
  return text + ")";
}

}  // namespace swarmsmith
