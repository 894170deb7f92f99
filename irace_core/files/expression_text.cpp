#include "irace_core/files/expression_text.h"

#include <algorithm>
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

/// Whether the expression lists more numbers than the evaluation allows, if this can be determined
/// without evaluating parameters.
bool is_long_range(const Expression& expression) {
  if (expression.operation() != Operation::Range) return false;
  for (const Expression& end : expression.operands()) {
    if (end.operation() != Operation::Constant) return false;
  }
  const auto first = expression.operands()[0].to_number({});
  const auto last = expression.operands()[1].to_number({});
  return first && last && std::fabs(*first - *last) >= kLongestRange;
}

/// Converts a tree of R to an expression.
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
          [&](const r::Null&) -> Result { return wrong("NULL has no meaning here", node); },
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

/// Handles operators first; all other calls are functions.
Expected<Expression> Reader::read_call(const r::Node& node, const r::Call& call) {
  std::string function = call.function;
  if (function == "&&" || function == "||") {
    const std::string single = function.substr(1);
    if (use_ == ExpressionUse::Value) {
      return wrong("found '" + function + "': write '" + single + "', as irace needs it", node);
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
    // R has no negative 0L: the minus stays an operation, or it would be lost when printed.
    const bool is_signed = number != nullptr && !(number->is_integer && number->value == 0);
    if (!is_signed) return Expression::call(Operation::Negate, std::move(*operands));
    return Expression::constant(number->is_integer ? Scalar::integer(-number->value)
                                                   : Scalar::real(-number->value));
  }
  if (is_sign) operands->insert(operands->begin(), Expression::integer(0));  // + x is 0L + x
  // `"+"(1, 2, 3)` looks like an operator, but is not one.
  if (operands->size() != 2) return wrong("'" + function + "' needs two operands", node);
  return Expression::call(is_sign ? Operation::Add : spelling->operation, std::move(*operands));
}

Expected<std::vector<Expression>> Reader::read_arguments(const r::Call& call) {
  // Printed text can have up to three levels for one level here (an operand, its parentheses, a
  // sign), and it must be possible to read it again.
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
      return wrong("a range of 10000 numbers or more is allowed only after %in%", argument.value);
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

}  // namespace swarmsmith
