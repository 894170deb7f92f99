#include "irace_core/expression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith {

Scalar Scalar::integer(double value) {
  if (!std::isfinite(value)) return missing_of(Type::Integer);
  // R's integers have 32 bits, but a parameter of a space may have larger whole numbers. These
  // become reals, as all parameter values are in irace.
  if (std::fabs(value) > irace::kLargestInteger) return real(value);
  return {Type::Integer, false, value + 0.0, {}};  // R's integers have no negative zero
}

Scalar Scalar::real(double value) {
  if (std::isnan(value)) return missing_of(Type::Real);
  return {Type::Real, false, value, {}};
}

Values::Values(std::vector<Scalar> many) : many_(std::move(many)) {
  SWARMSMITH_ASSERT(!many_.empty(), "a vector of values has an element");
  if (many_.size() > 1) return;
  one_ = std::move(many_.front());
  many_.clear();
}

Arity arity(Operation operation) {
  constexpr std::size_t kAny = 1'000'000;
  switch (operation) {
    case Operation::Constant:
    case Operation::Parameter:
      return {0, 0};
    case Operation::Not:
    case Operation::Negate:
    case Operation::AsNumeric:
    case Operation::AsInteger:
    case Operation::AsText:
    case Operation::IsMissing:
    case Operation::Floor:
    case Operation::Ceiling:
    case Operation::Truncate:
    case Operation::Abs:
    case Operation::SquareRoot:
    case Operation::Exp:
      return {1, 1};
    case Operation::Round:
    case Operation::Log:
      return {1, 2};
    case Operation::IfElse:
      return {3, 3};
    case Operation::Combine:
    case Operation::Min:
    case Operation::Max:
      return {1, kAny};
    case Operation::And:
    case Operation::Or:
    case Operation::Xor:
    case Operation::Equal:
    case Operation::NotEqual:
    case Operation::Less:
    case Operation::LessEqual:
    case Operation::Greater:
    case Operation::GreaterEqual:
    case Operation::In:
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
    case Operation::Divide:
    case Operation::Power:
    case Operation::Modulo:
    case Operation::IntegerDivide:
    case Operation::Range:
      return {2, 2};
  }
  return {0, 0};
}

Expression Expression::constant(Scalar value) {
  Expression expression;
  expression.constant_ = std::move(value);
  return expression;
}

Expression Expression::parameter(std::string name) {
  Expression expression;
  expression.operation_ = Operation::Parameter;
  expression.name_ = std::move(name);
  return expression;
}

Expression Expression::call(Operation operation, std::vector<Expression> operands) {
  const Arity wanted = arity(operation);
  if (wanted.most == 0 || operands.size() < wanted.least || operands.size() > wanted.most) {
    throw std::invalid_argument("an operation got " + std::to_string(operands.size()) +
                                " operands, which does not fit it");
  }
  Expression expression;
  expression.operation_ = operation;
  // Elements of one type need no coercion, so evaluation can use the list as it is.
  expression.is_list_of_constants_ =
      operation == Operation::Combine &&
      std::all_of(operands.begin(), operands.end(), [&](const Expression& operand) {
        return operand.operation_ == Operation::Constant &&
               operand.constant_.type == operands.front().constant_.type;
      });
  expression.operands_ = std::move(operands);
  return expression;
}

Expression Expression::in(Expression x, std::vector<Expression> values) {
  std::vector<Expression> operands;
  operands.push_back(std::move(x));
  operands.push_back(call(Operation::Combine, std::move(values)));
  return call(Operation::In, std::move(operands));
}

std::vector<std::string> Expression::names() const {
  std::vector<std::string> names;
  collect_names(names);
  return names;
}

void Expression::collect_names(std::vector<std::string>& names) const {
  if (operation_ == Operation::Parameter &&
      std::find(names.begin(), names.end(), name_) == names.end()) {
    names.push_back(name_);
  }
  for (const Expression& operand : operands_)
    operand.collect_names(names);
}

Expected<void> Expression::bind(std::span<const std::string> names) {
  if (operation_ == Operation::Parameter) {
    const auto found = std::find(names.begin(), names.end(), name_);
    if (found == names.end()) return bad_input("there is no parameter '" + name_ + "'");
    index_ = static_cast<int>(found - names.begin());
  }
  for (Expression& operand : operands_) {
    if (auto bound = operand.bind(names); !bound) return bound;
  }
  return {};
}

/// irace facts, 8.2: FALSE and NA make a parameter inactive. So does a value that is no single
/// logical.
bool Expression::is_true(std::span<const Scalar> parameters) const {
  const Values values = evaluate(parameters);
  return values.size() == 1 && values[0].type == Scalar::Type::Logical && !values[0].missing &&
         values[0].number != 0;
}

/// A text is not converted: that is the task of as.numeric.
std::optional<double> Expression::to_number(std::span<const Scalar> parameters) const {
  const Values values = evaluate(parameters);
  if (values.size() != 1 || values[0].missing || values[0].type == Scalar::Type::Text) return {};
  return values[0].number;
}

bool operator==(const Expression& a, const Expression& b) {
  return a.operation_ == b.operation_ && a.name_ == b.name_ && a.constant_ == b.constant_ &&
         a.operands_ == b.operands_;
}

}  // namespace swarmsmith
