#include "irace_core/internal/check_parameter.h"

#include <algorithm>
#include <cmath>

#include "base/overloaded.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::irace {
namespace {

/// irace facts, 23.2: letters, digits, `_` and `.`. Bytes of 0x80 and above are parts of characters
/// in UTF-8.
bool is_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || static_cast<unsigned char>(c) >= 0x80;
  });
}

bool is_numeric_domain(const Domain& domain) {
  return std::holds_alternative<Integer>(domain) || std::holds_alternative<Real>(domain);
}

bool is_number_or_parameter(const Expression& expression) {
  if (expression.operation() == Operation::Parameter) return true;
  return expression.operation() == Operation::Constant &&
         expression.evaluate({})[0].type != Scalar::Type::Text;
}

/// Bounds may use + - * / %% min max round floor ceiling trunc; constant bounds may also use the
/// other functions and operators that give one number from one or two.
bool only_arithmetic(const Expression& expression, bool is_constant) {
  constexpr Operation kAllowed[] = {Operation::Add,    Operation::Subtract, Operation::Multiply,
                                    Operation::Divide, Operation::Modulo,   Operation::Negate,
                                    Operation::Min,    Operation::Max,      Operation::Round,
                                    Operation::Floor,  Operation::Ceiling,  Operation::Truncate};
  constexpr Operation kConstant[] = {Operation::Power, Operation::IntegerDivide,
                                     Operation::Abs,   Operation::SquareRoot,
                                     Operation::Exp,   Operation::Log};
  const auto is_among = [&expression](std::span<const Operation> operations) {
    return std::find(operations.begin(), operations.end(), expression.operation()) !=
           operations.end();
  };
  if (expression.operands().empty()) return is_number_or_parameter(expression);
  if (!is_among(kAllowed) && !(is_constant && is_among(kConstant))) return false;
  return std::all_of(
      expression.operands().begin(), expression.operands().end(),
      [is_constant](const Expression& operand) { return only_arithmetic(operand, is_constant); });
}

/// Binds one bound and checks the parameters that it mentions.
Expected<void> bind_bound(Bound& bound, const std::string& owner,
                          std::span<const std::string> names, std::span<const Parameter> all) {
  Expression* expression = std::get_if<Expression>(&bound);
  if (expression == nullptr) return {};
  if (auto bound_names = expression->bind(names); !bound_names) {
    return bad_input(bound_names.error().message, owner);
  }
  const std::vector<std::string> mentioned = expression->names();
  if (!only_arithmetic(*expression, mentioned.empty())) {
    return bad_input("a bound may use + - * / %% min max round floor ceiling trunc", owner);
  }
  // irace facts, 23.2: a constant bound is computed once, when the space is made.
  if (mentioned.empty()) {
    const std::optional<double> value = expression->to_number({});
    if (!value) return bad_input("a bound is not a number", owner);
    bound = *value;
    return {};
  }
  for (const std::string& name : mentioned) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    // irace facts, 8.3: the values of categorical and ordinal parameters are texts, with which a
    // bound cannot compute.
    if (!is_numeric_domain(all[static_cast<std::size_t>(at)].domain)) {
      return bad_input("a bound depends on '" + name + "', which is not numeric", owner);
    }
  }
  return {};
}

Expected<void> check_choices(const std::vector<std::string>& values, const std::string& name) {
  if (values.empty()) return bad_input("the domain is empty", name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]) !=
        values.begin() + static_cast<std::ptrdiff_t>(i)) {
      return bad_input("the value '" + values[i] + "' occurs twice", name);
    }
  }
  return {};
}

/// Ordinal values that are all numbers must increase.
Expected<void> check_increasing(const std::vector<std::string>& values, const std::string& name) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    // R's as.numeric decides whether a value is a number. If one is not, any order is allowed.
    const std::optional<double> number =
        Expression::call(Operation::AsNumeric, {Expression::text(value)}).to_number({});
    if (!number) return {};
    numbers.push_back(*number);
  }
  // Equal numbers are allowed: "1" and "1.0" are different values.
  if (std::is_sorted(numbers.begin(), numbers.end())) return {};
  return bad_input("the values of an ordinal parameter must increase", name);
}

Expected<void> check_decimals(double bound, int digits, const std::string& name) {
  if (fits_digits(bound, digits)) return {};
  // The error gives the number of digits that is enough (irace facts, 23.2); 15 always are.
  int needed = digits;
  while (!fits_digits(bound, needed))
    ++needed;
  return bad_input("the bound " + exact_text(bound) + " does not fit digits = " +
                       std::to_string(digits) + "; it needs digits = " + std::to_string(needed),
                   name);
}

template <class Numeric>
Expected<void> check_numeric(const Numeric& domain, bool whole, int digits,
                             const std::string& name) {
  const double* lower = std::get_if<double>(&domain.lower);
  const double* upper = std::get_if<double>(&domain.upper);
  // irace facts, 8.3.
  if (domain.log && (lower == nullptr || upper == nullptr)) {
    return bad_input("a logarithmic domain must not depend on other parameters", name);
  }
  for (const double* bound : {lower, upper}) {
    if (bound == nullptr) continue;
    if (!std::isfinite(*bound)) return bad_input("a bound is not finite", name);
    if (domain.log && *bound <= 0) return bad_input("a logarithmic bound must be positive", name);
    if (whole && *bound != std::floor(*bound)) {
      return bad_input("the bound " + exact_text(*bound) + " is not a whole number", name);
    }
    const auto checked = whole ? check_whole(*bound, name) : check_decimals(*bound, digits, name);
    if (!checked) return checked;
  }
  // irace facts, 23.2: for a fixed value one uses a categorical parameter. A dependent domain may
  // have equal bounds (8.3).
  if (lower != nullptr && upper != nullptr && *lower >= *upper) {
    return bad_input("the lower bound must be below the upper one", name);
  }
  return {};
}

}  // namespace

Expected<void> check_whole(double bound, const std::string& name) {
  if (std::fabs(bound) <= kLargestWhole) return {};
  return bad_input("the bound " + exact_text(bound) +
                       " is too large: whole numbers are exact up to " + exact_text(kLargestWhole) +
                       "; tune its logarithm instead",
                   name);
}

int digits_needed(std::span<const Parameter> parameters, int digits) {
  for (const Parameter& parameter : parameters) {
    const auto* real = std::get_if<Real>(&parameter.domain);
    if (real == nullptr) continue;
    for (const Bound* bound : {&real->lower, &real->upper}) {
      const double* value = std::get_if<double>(bound);
      while (value != nullptr && std::isfinite(*value) && !fits_digits(*value, digits))
        ++digits;
    }
  }
  return digits;
}

bool fits_digits(double bound, int digits) {
  if (digits >= 15 || bound == 0) return true;
  double smallest = 1;
  for (int i = 0; i < digits; ++i)
    smallest /= 10;
  // The two conditions of irace facts, 23.2. The factor allows for the rounding of `smallest`.
  if (std::fabs(bound) < smallest * (1 - 1e-9)) return false;
  const double tolerance = 1.5e-8 * std::max(1.0, std::fabs(bound));
  return std::fabs(round_to_digits(bound, digits) - bound) <= tolerance;
}

std::vector<const Expression*> bound_expressions(const Domain& domain) {
  std::vector<const Expression*> expressions;
  const auto add = [&expressions](const auto& numeric) {
    for (const Bound* bound : {&numeric.lower, &numeric.upper}) {
      if (const auto* expression = std::get_if<Expression>(bound)) {
        expressions.push_back(expression);
      }
    }
  };
  if (const auto* whole = std::get_if<Integer>(&domain)) add(*whole);
  if (const auto* real = std::get_if<Real>(&domain)) add(*real);
  return expressions;
}

std::span<const std::string> choice_values(const Domain& domain) {
  if (const auto* categorical = std::get_if<Categorical>(&domain)) return categorical->values;
  if (const auto* ordinal = std::get_if<Ordinal>(&domain)) return ordinal->values;
  return {};
}

std::optional<Interval> constant_interval(const Domain& domain) {
  if (!bound_expressions(domain).empty()) return std::nullopt;
  const auto interval = [](const auto& numeric) {
    return Interval{std::get<double>(numeric.lower), std::get<double>(numeric.upper)};
  };
  if (const auto* whole = std::get_if<Integer>(&domain)) return interval(*whole);
  if (const auto* real = std::get_if<Real>(&domain)) return interval(*real);
  return Interval{0, 0};
}

Expected<void> bind_parameter(Parameter& parameter, std::span<const std::string> names,
                              std::span<const Parameter> all) {
  if (parameter.condition) {
    // irace facts, 8.1: an unknown name is an error.
    if (auto bound = parameter.condition->bind(names); !bound) {
      return bad_input(bound.error().message, parameter.name);
    }
  }
  const auto bind_both = [&](auto& domain) -> Expected<void> {
    if (auto bound = bind_bound(domain.lower, parameter.name, names, all); !bound) return bound;
    return bind_bound(domain.upper, parameter.name, names, all);
  };
  if (auto* whole = std::get_if<Integer>(&parameter.domain)) return bind_both(*whole);
  if (auto* real = std::get_if<Real>(&parameter.domain)) return bind_both(*real);
  return {};
}

Expected<void> check_parameter(const Parameter& parameter, int digits) {
  const std::string& name = parameter.name;
  if (!is_name(name)) {
    return bad_input("a name consists of letters, digits, '_' and '.'", name);
  }
  return std::visit(
      Overloaded{
          [&](const Categorical& domain) { return check_choices(domain.values, name); },
          [&](const Ordinal& domain) -> Expected<void> {
            if (auto checked = check_choices(domain.values, name); !checked) return checked;
            return check_increasing(domain.values, name);
          },
          [&](const Integer& domain) { return check_numeric(domain, true, digits, name); },
          [&](const Real& domain) { return check_numeric(domain, false, digits, name); },
      },
      parameter.domain);
}

}  // namespace swarmsmith::irace
