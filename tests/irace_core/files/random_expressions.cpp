#include "tests/irace_core/files/random_expressions.h"

#include <array>
#include <cmath>
#include <limits>

namespace swarmsmith::testing {

using enum Operation;

Expression RandomExpressions::number() {
  constexpr std::array<double, 10> kNumbers = {0,
                                               -0.0,
                                               0.1,
                                               1e5,
                                               1e-7,
                                               1.0 / 3,
                                               123456789012345678.0,
                                               -2.5,
                                               5e-324,
                                               std::numeric_limits<double>::infinity()};
  const int kind = below(3);
  if (kind == 0) return Expression::integer(static_cast<std::int32_t>(below(20)) - 10);
  if (kind == 1) return Expression::number(kNumbers.at(static_cast<std::size_t>(below(10))));
  return Expression::number(rng_->uniform(-1000, 1000));
}

Expression RandomExpressions::leaf() {
  const std::array<std::string, 9> texts = {"",          "a b",         "it's",
                                            "say \"x\"", "back\\slash", "tab\tline\n\x01\x7f",
                                            "gr\u00fcn", "# | )",       "TRUE"};
  switch (below(8)) {
    case 0:
      return Expression::logical(below(2) == 0);
    case 1:
      return Expression::constant(Scalar::missing_of(
          std::array{Scalar::Type::Logical, Scalar::Type::Integer, Scalar::Type::Real,
                     Scalar::Type::Text}[static_cast<std::size_t>(below(4))]));
    case 2:
    case 3:
      return Expression::text(texts.at(static_cast<std::size_t>(below(9))));
    case 4:
    case 5:
      return number();
    default:
      return Expression::parameter(
          names_[static_cast<std::size_t>(below(static_cast<int>(names_.size())))]);
  }
}

Expression RandomExpressions::any(int depth) {
  constexpr auto kFirst = static_cast<int>(Not);
  constexpr auto kLast = static_cast<int>(Log);
  if (depth <= 1 || below(8) == 0) return leaf();
  const auto operation = static_cast<Operation>(kFirst + below(kLast - kFirst + 1));
  const Arity takes = arity(operation);
  const auto least = static_cast<int>(takes.least);
  const int count =
      takes.most > 3 ? 1 + below(4) : least + below(static_cast<int>(takes.most) - least + 1);
  std::vector<Expression> operands;
  for (int i = 0; i < count; ++i)
    operands.push_back(any(depth - 1));
  // Minus before a plain number reads back as a negative constant, but R has no negative 0L; ranges
  // of constants may be long.
  const auto is_constant = [](const Expression& one) { return one.operation() == Constant; };
  if (operation == Negate && is_constant(operands[0])) {
    const Scalar value = operands[0].evaluate({})[0];
    const bool is_number = value.type == Scalar::Type::Real ||
                           (value.type == Scalar::Type::Integer && value.number != 0);
    if (is_number && !value.missing && !std::signbit(value.number)) return operands[0];
  }
  if (operation == Range && is_constant(operands[0]) && is_constant(operands[1])) {
    return Expression::call(Add, std::move(operands));
  }
  return Expression::call(operation, std::move(operands));
}

Expression RandomExpressions::bound(int depth) {
  constexpr std::array kOperations = {Add, Subtract, Multiply, Modulo,  Min,
                                      Max, Round,    Floor,    Ceiling, Truncate};
  if (depth <= 1) {
    return Expression::parameter(
        names_[static_cast<std::size_t>(below(static_cast<int>(names_.size())))]);
  }
  const Operation operation = kOperations.at(static_cast<std::size_t>(below(10)));
  std::vector<Expression> operands;
  operands.push_back(bound(depth - 1));
  if (arity(operation).most > 2 || arity(operation).least == 2) {
    operands.push_back(Expression::number(1 + below(9)));
  }
  return Expression::call(operation, std::move(operands));
}

}  // namespace swarmsmith::testing
