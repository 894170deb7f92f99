#include "irace_core/files/expression_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/overloaded.h"
#include "base/suggestion.h"
#include "irace_core/files/internal/r_operators.h"

namespace swarmsmith {
namespace {

using Type = Scalar::Type;

Unexpected wrong(std::string message, const r::Node& node) {
  return bad_input(std::move(message), r::to_string(node.place));
}

/// Whether the expression lists more numbers than are evaluated, as far as can be told here.
bool is_long_range(const Expression& expression) {
  if (expression.operation() != Operation::Range) return false;
  for (const Expression& end : expression.operands()) {
    if (end.operation() != Operation::Constant) return false;
  }
  const auto first = expression.operands()[0].to_number({});
  const auto last = expression.operands()[1].to_number({});
  return first && last && std::fabs(*first - *last) >= kLongestRange;
}

/// Turns a tree of R into an expression.
class Reader {
 public:
  Reader(std::span<const std::string> names, ExpressionUse use, std::vector<Error>& warnings)
      : names_(names), use_(use), warnings_(warnings) {}

  Expected<Expression> read(const r::Node& node);

 private:
  Expected<Expression> read_name(const r::Node& node, const std::string& name) const;
  Expected<Expression> read_call(const r::Node& node, const r::Call& call);
  Expected<Expression> read_function(const r::Node& node, const r::Call& call);
  Expected<std::vector<Expression>> read_arguments(const r::Call& call);

  std::span<const std::string> names_;
  ExpressionUse use_;
  std::vector<Error>& warnings_;
  int nesting_ = 0;
};

Expected<Expression> Reader::read(const r::Node& node) {
  using Result = Expected<Expression>;
  return std::visit(
      Overloaded{
          [](const r::Number& number) -> Result {
            return Expression::constant(number.is_integer ? Scalar::integer(number.value)
                                                          : Scalar::real(number.value));
          },
          [](const r::Text& text) -> Result { return Expression::text(text.value); },
          [&](const r::Name& name) { return read_name(node, name.value); },
          [](const r::Logical& logical) -> Result {
            return logical.value ? Expression::logical(*logical.value) : Expression::missing();
          },
          [&](const r::Null&) -> Result { return wrong("NULL means nothing here", node); },
          [&](const r::Call& call) { return read_call(node, call); },
      },
      node.what);
}

Expected<Expression> Reader::read_name(const r::Node& node, const std::string& name) const {
  if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
    return Expression::parameter(name);
  }
  if (const std::optional<bool> logical = r::logical_of(node)) return Expression::logical(*logical);
  if (name == "NA_integer_") return Expression::constant(Scalar::missing_of(Type::Integer));
  if (name == "NA_real_") return Expression::constant(Scalar::missing_of(Type::Real));
  if (name == "NA_character_") return Expression::constant(Scalar::missing_of(Type::Text));
  const std::string meant = did_you_mean(name, names_);
  return wrong("there is no parameter '" + name + "'" +
                   (meant.empty() ? " (a text needs quotes: \"" + name + "\")" : meant),
               node);
}

/// Operators first, then functions.
Expected<Expression> Reader::read_call(const r::Node& node, const r::Call& call) {
  std::string function = call.function;
  if (function == "&&" || function == "||") {
    const std::string single = function.substr(1);
    if (use_ == ExpressionUse::Value) {
      return wrong("found '" + function + "': write '" + single + "', as irace wants it", node);
    }
    warnings_.push_back({ErrorKind::BadInput, "'" + function + "' is read as '" + single + "'",
                         r::to_string(node.place)});
    function = single;
  }
  const bool is_sign = call.arguments.size() == 1 && (function == "-" || function == "+");
  const irace::Spelling* spelling = is_sign ? nullptr : irace::find_operator(function);
  if (!is_sign && function != "!" && spelling == nullptr) {
    if (function.front() != '%') return read_function(node, call);
    return wrong("there is no operator " + function + " here; there are %in%, %% and %/%", node);
  }
  auto operands = read_arguments(call);
  if (!operands) return Unexpected(operands.error());
  if (function == "!" && operands->size() == 1) {
    return Expression::call(Operation::Not, std::move(*operands));
  }
  if (is_sign && function == "-") {
    const auto* number = std::get_if<r::Number>(&call.arguments.front().value.what);
    if (number == nullptr) return Expression::call(Operation::Negate, std::move(*operands));
    return Expression::constant(number->is_integer ? Scalar::integer(-number->value)
                                                   : Scalar::real(-number->value));
  }
  if (is_sign) operands->insert(operands->begin(), Expression::integer(0));  // + x is 0L + x
  // `"+"(1, 2, 3)` looks like an operator and is none.
  if (operands->size() != 2) return wrong("'" + function + "' needs two operands", node);
  return Expression::call(is_sign ? Operation::Add : spelling->operation, std::move(*operands));
}

Expected<std::vector<Expression>> Reader::read_arguments(const r::Call& call) {
  // What is printed has up to three levels for one here (an operand, its parentheses, a sign), and
  // must be read again.
  constexpr int kDeepestNesting = 100;
  const bool is_operator = call.arguments.size() == 2 && irace::find_operator(call.function);
  std::vector<Expression> operands;
  for (const r::Argument& argument : call.arguments) {
    const int levels = is_operator && operands.empty() ? 0 : 1;
    nesting_ += levels;
    if (nesting_ > kDeepestNesting) {
      return wrong("this expression is nested too deeply", argument.value);
    }
    auto operand = read(argument.value);
    if (!operand) return Unexpected(operand.error());
    nesting_ -= levels;
    const bool searched = call.function == "%in%" && !operands.empty();
    if (!searched && is_long_range(*operand)) {
      return wrong("a range of 10000 numbers or more may only stand behind %in%", argument.value);
    }
    operands.push_back(std::move(*operand));
  }
  return operands;
}

Expected<Expression> Reader::read_function(const r::Node& node, const r::Call& call) {
  const irace::Spelling* function = irace::find_function(call.function);
  if (function == nullptr) {
    return wrong("there is no function '" + call.function + "' here; there are " +
                     std::string(irace::function_names()),
                 node);
  }
  for (const r::Argument& argument : call.arguments) {
    const bool second = &argument == &call.arguments.back() && call.arguments.size() == 2;
    const bool fits = argument.name.empty() || function->operation == Operation::Combine ||
                      (second && call.function == "round" && argument.name == "digits") ||
                      (second && call.function == "log" && argument.name == "base");
    if (!fits) {
      return wrong("the argument '" + argument.name + "' of " + call.function +
                       "() is not known here; give arguments by position",
                   argument.value);
    }
  }
  const Arity takes = arity(function->operation);
  const std::size_t given = call.arguments.size();
  if (given < takes.least || given > takes.most) {
    const std::string most = takes.most > 3 ? " or more" : takes.most > takes.least ? " or 2" : "";
    return wrong(call.function + "() takes " + std::to_string(takes.least) + most +
                     " arguments, found " + std::to_string(given),
                 node);
  }
  auto operands = read_arguments(call);
  if (!operands) return Unexpected(operands.error());
  return Expression::call(function->operation, std::move(*operands));
}

/// The fewest digits that read back as the same number, without an exponent where that is short.
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
    } else if (code < 0x20 || code == 0x7F) {  // so that a line stays a line
      text += std::string("\\x") + kHexadecimal[code / 16] + kHexadecimal[code % 16];
    } else {
      text += c;
    }
  }
  return text + "\"";
}

/// In backticks where R would not read the name as one.
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
  const bool is_power = op.binding == irace::kBindingOfPower;  // goes on to the right
  const bool is_tight = is_power || op.operation == Operation::Range;
  const bool may_chain = !is_power && op.binding != irace::kBindingOfComparison;
  const std::string blank = is_tight ? "" : " ";
  return print_at_least(left, may_chain ? op.binding : op.binding + 1) + blank +
         std::string(op.text) + blank +
         print_at_least(right, is_power ? op.binding : op.binding + 1);
}

}  // namespace

Expected<Expression> parse_expression(std::string_view text, std::span<const std::string> names,
                                      ExpressionUse use, r::Place start,
                                      std::vector<Error>& warnings) {
  const auto tree = r::parse_expression(text, start);
  if (!tree) return Unexpected(tree.error());
  return Reader(names, use, warnings).read(*tree);
}

Expected<Expression> to_expression(const r::Node& node, std::span<const std::string> names,
                                   ExpressionUse use, std::vector<Error>& warnings) {
  return Reader(names, use, warnings).read(node);
}

std::string print(const Expression& expression) {
  const std::span<const Expression> operands = expression.operands();
  const Operation operation = expression.operation();
  if (operation == Operation::Constant) return print_constant(expression.evaluate({})[0]);
  if (operation == Operation::Parameter) return print_name(expression.name());
  if (operation == Operation::Not) {
    // Parentheses that are not needed, but that readers of !a == b would like to see.
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
