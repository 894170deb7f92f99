// Evaluation of expressions: R's vectors, coercions and three-valued logic.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "base/assert.h"
#include "base/math.h"
#include "irace_core/expression.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith {
namespace {

using Type = Scalar::Type;

Scalar missing_logical() {
  return Scalar::missing_of(Type::Logical);
}

/// R's as.numeric of a text: a decimal number, which may have blanks around it, or Inf; otherwise
/// missing.
Scalar parse_number(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\n\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return Scalar::missing_of(Type::Real);
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size();
  return whole ? Scalar::real(value) : Scalar::missing_of(Type::Real);
}

/// R's coercion of one value to another type; a value that cannot be coerced becomes missing.
Scalar convert(const Scalar& value, Type type) {
  if (value.type == type) return value;
  if (value.missing) return Scalar::missing_of(type);
  switch (type) {
    case Type::Text:
      return Scalar::of_text(to_text(value));
    case Type::Logical:
      if (value.type == Type::Text) return missing_logical();
      return Scalar::logical(value.number != 0);
    case Type::Real:
      return value.type == Type::Text ? parse_number(value.text) : Scalar::real(value.number);
    case Type::Integer: {
      const Scalar number = convert(value, Type::Real);
      return number.missing ? Scalar::missing_of(type) : Scalar::integer(std::trunc(number.number));
    }
  }
  return {};
}

bool is_number(const Scalar& value) {
  return value.type != Type::Text;
}
bool is_false(const Scalar& value) {
  return !value.missing && value.number == 0;
}
bool is_true_logical(const Scalar& value) {
  return !value.missing && value.number != 0;
}

/// And, Or, Xor with three values: one known operand may decide the result.
Scalar logic(Operation operation, const Scalar& left, const Scalar& right) {
  const Scalar a = convert(left, Type::Logical);
  const Scalar b = convert(right, Type::Logical);
  if (operation == Operation::And) {
    if (is_false(a) || is_false(b)) return Scalar::logical(false);
  } else if (operation == Operation::Or) {
    if (is_true_logical(a) || is_true_logical(b)) return Scalar::logical(true);
  }
  if (a.missing || b.missing) return missing_logical();
  if (operation == Operation::Xor) return Scalar::logical(a.number != b.number);
  return Scalar::logical(operation == Operation::And);
}

/// Sign of a - b, for two values that are not missing; if one of them is a text, both are compared
/// as texts.
int order(const Scalar& a, const Scalar& b) {
  if (is_number(a) && is_number(b)) return a.number < b.number ? -1 : a.number > b.number;
  if (is_number(a)) return compare_texts(to_text(a), b.text);
  if (is_number(b)) return compare_texts(a.text, to_text(b));
  return compare_texts(a.text, b.text);
}

/// == != < <= > >=; missing if either side is missing.
Scalar compare(Operation operation, const Scalar& a, const Scalar& b) {
  if (a.missing || b.missing) return missing_logical();
  const int sign = order(a, b);
  bool holds = sign >= 0;  // GreaterEqual
  if (operation == Operation::Equal) holds = sign == 0;
  if (operation == Operation::NotEqual) holds = sign != 0;
  if (operation == Operation::Less) holds = sign < 0;
  if (operation == Operation::LessEqual) holds = sign <= 0;
  if (operation == Operation::Greater) holds = sign > 0;
  return Scalar::logical(holds);
}

/// The power, by repeated squaring for whole exponents, so that powers of small integers are exact.
double power(double base, double exponent) {
  if (base == 1 || exponent == 0) return 1;
  if (exponent == std::floor(exponent) && std::fabs(exponent) <= 1'000'000) {
    double result = 1;
    double square = base;
    for (auto n = static_cast<std::uint64_t>(std::fabs(exponent)); n > 0; n /= 2) {
      if (n % 2 == 1) result *= square;
      square *= square;
    }
    return exponent < 0 ? 1 / result : result;
  }
  if (base == 0) return exponent > 0 ? 0 : HUGE_VAL;
  return base > 0 ? pow(base, exponent) : NAN;
}

/// The remainder a - floor(a / b) b, which has the sign of b: NaN for b = 0. For an infinite b the
/// result is a if both have the same sign, otherwise b (R's Arithmetic).
double modulo(double a, double b) {
  if (b == 0 || !std::isfinite(a)) return NAN;
  if (std::isinf(b)) return a == 0 || (a < 0) == (b < 0) ? a : b;
  return a - std::floor(a / b) * b;
}

/// floor(a / b); for an infinite b it is 0, or -1 if a and b have opposite signs.
double whole_quotient(double a, double b) {
  if (std::isinf(b) && std::isfinite(a)) return a == 0 || (a < 0) == (b < 0) ? 0 : -1;
  return std::floor(a / b);
}

Scalar calculate(Operation operation, const Scalar& left, const Scalar& right) {
  if (left.missing || right.missing || !is_number(left) || !is_number(right)) {
    return Scalar::missing_of(Type::Real);
  }
  const bool whole = left.type != Type::Real && right.type != Type::Real;
  const double a = left.number;
  const double b = right.number;
  const auto typed = [whole](double value) {
    return whole ? Scalar::integer(value) : Scalar::real(value);
  };
  if (operation == Operation::Add) return typed(a + b);
  if (operation == Operation::Subtract) return typed(a - b);
  if (operation == Operation::Multiply) return typed(a * b);
  if (operation == Operation::Divide) return Scalar::real(a / b);
  if (operation == Operation::Power) return Scalar::real(power(a, b));
  if (operation == Operation::Modulo) return typed(modulo(a, b));
  return typed(whole_quotient(a, b));  // IntegerDivide
}

/// The functions of one number; only Round uses `digits`.
Scalar transform(Operation operation, const Scalar& x, double digits) {
  if (x.missing || !is_number(x)) return Scalar::missing_of(Type::Real);
  const double v = x.number;
  const bool whole = x.type != Type::Real;
  if (operation == Operation::Negate) return whole ? Scalar::integer(-v) : Scalar::real(-v);
  if (operation == Operation::Abs) return {x.type, false, std::fabs(v), {}};
  if (operation == Operation::Floor) return Scalar::real(std::floor(v));
  if (operation == Operation::Ceiling) return Scalar::real(std::ceil(v));
  if (operation == Operation::Truncate) return Scalar::real(std::trunc(v));
  if (operation == Operation::SquareRoot) return Scalar::real(std::sqrt(v));
  if (operation == Operation::Exp) return Scalar::real(exp(v));
  if (operation == Operation::Log) return Scalar::real(log(v));
  const double whole_digits = std::floor(digits + 0.5);
  const int decimals = static_cast<int>(std::clamp(whole_digits, -irace::kMostZeros, 15.0));
  return Scalar::real(irace::round_to_digits(v, decimals));  // Round
}

bool is_logic(Operation operation) {
  return operation >= Operation::And && operation <= Operation::Xor;
}
bool is_comparison(Operation operation) {
  return operation >= Operation::Equal && operation <= Operation::GreaterEqual;
}

/// Applies an operation to one element of each side.
Scalar binary(Operation operation, const Scalar& a, const Scalar& b) {
  if (is_logic(operation)) return logic(operation, a, b);
  if (is_comparison(operation)) return compare(operation, a, b);
  if (operation == Operation::Round)
    return b.missing ? Scalar::missing_of(Type::Real) : transform(operation, a, b.number);
  if (operation == Operation::Log) {  // to the base b
    return calculate(Operation::Divide, transform(operation, a, 0), transform(operation, b, 0));
  }
  return calculate(operation, a, b);
}

Scalar unary(Operation operation, const Scalar& x) {
  if (operation == Operation::Not) {
    const Scalar value = convert(x, Type::Logical);
    return value.missing ? value : Scalar::logical(value.number == 0);
  }
  if (operation == Operation::AsNumeric) return convert(x, Type::Real);
  if (operation == Operation::AsInteger) return convert(x, Type::Integer);
  if (operation == Operation::AsText) return convert(x, Type::Text);
  if (operation == Operation::IsMissing) return Scalar::logical(x.missing);
  return transform(operation, x, 0);
}

/// Applies `function` to the elements of both vectors; the shorter one is repeated.
template <class Function>
Values elementwise(const Values& a, const Values& b, Function function) {
  const std::size_t size = std::max(a.size(), b.size());
  if (size == 1) return function(a[0], b[0]);
  std::vector<Scalar> result;
  result.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    result.push_back(function(a[i % a.size()], b[i % b.size()]));
  }
  return Values(std::move(result));
}

/// c(): all elements in one vector, converted to the most general of their types.
Values combine(const std::vector<Values>& parts) {
  Type type = Type::Logical;
  for (const Values& part : parts)
    type = std::max(type, part.type());
  std::vector<Scalar> all;
  for (const Values& part : parts) {
    for (std::size_t i = 0; i < part.size(); ++i)
      all.push_back(convert(part[i], type));
  }
  return Values(std::move(all));
}

/// min() and max() over all elements of all operands; missing if one element is missing.
Values extreme(Operation operation, const std::vector<Values>& parts) {
  const Values all = combine(parts);
  Scalar best = all[0];
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].missing) return Scalar::missing_of(all.type());
    const int sign = order(all[i], best);
    if (operation == Operation::Min ? sign < 0 : sign > 0) best = all[i];
  }
  // The minimum or maximum of logicals is a number.
  return best.type == Type::Logical ? convert(best, Type::Integer) : best;
}

/// from:to in steps of one, up or down; integers if `from` is a whole number.
struct Sequence {
  double first = 0;
  double step = 1;
  double steps = 0;
  bool whole = true;

  Scalar at(double i) const {
    const double value = first + step * i;
    return whole ? Scalar::integer(value) : Scalar::real(value);
  }
};

/// The sequence from:to; nothing if an end is missing or not a number.
std::optional<Sequence> sequence(const Values& from, const Values& to) {
  const Scalar first = convert(from[0], Type::Real);
  const Scalar last = convert(to[0], Type::Real);
  const double width = std::fabs(first.number - last.number);
  if (first.missing || last.missing || !std::isfinite(width)) return std::nullopt;
  const double largest = std::max(std::fabs(first.number), std::fabs(last.number));
  return Sequence{first.number, first.number <= last.number ? 1.0 : -1.0, std::floor(width + 1e-10),
                  first.number == std::floor(first.number) && largest <= irace::kLargestInteger};
}

Values range(const Values& from, const Values& to) {
  const std::optional<Sequence> numbers = sequence(from, to);
  if (!numbers || numbers->steps >= kLongestRange) return Scalar::missing_of(Type::Integer);
  std::vector<Scalar> result;
  const auto steps = static_cast<int>(numbers->steps);
  result.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i)
    result.push_back(numbers->at(i));
  return Values(std::move(result));
}

/// Whether x equals an element of a table: missing matches only missing, and if one is a text, both
/// are compared as texts.
bool matches(const Scalar& x, const Scalar& candidate) {
  if (x.missing || candidate.missing) return x.missing && candidate.missing;
  if (x.type == Type::Text && candidate.type == Type::Text) return x.text == candidate.text;
  return order(x, candidate) == 0;
}

/// x %in% from:to, without making a list of the numbers.
Scalar is_in_sequence(const Scalar& x, const Sequence& numbers) {
  const Scalar number = convert(x, Type::Real);
  if (number.missing) return Scalar::logical(false);
  const double i = std::floor(std::fabs(number.number - numbers.first) + 0.5);
  return Scalar::logical(i <= numbers.steps && matches(x, numbers.at(i)));
}

/// x %in% table, for each element of x. All elements of a vector have the same type, so that either
/// all comparisons are between numbers or all are between texts.
Values find_each(const Values& x, const Values& table) {
  const bool as_texts = x.type() == Type::Text || table.type() == Type::Text;
  const auto less = [as_texts](const Scalar& a, const Scalar& b) {
    if (a.missing || b.missing) return a.missing && !b.missing;
    return as_texts ? to_text(a) < to_text(b) : a.number < b.number;
  };
  std::vector<Scalar> sorted;
  for (std::size_t i = 0; i < table.size(); ++i)
    sorted.push_back(as_texts ? convert(table[i], Type::Text) : table[i]);
  std::sort(sorted.begin(), sorted.end(), less);
  std::vector<Scalar> found;
  for (std::size_t i = 0; i < x.size(); ++i) {
    found.push_back(Scalar::logical(std::binary_search(sorted.begin(), sorted.end(), x[i], less)));
  }
  return Values(std::move(found));
}

/// ifelse(): element by element, `yes` and `no` repeated as needed.
Values choose(const Values& tests, const Values& yes, const Values& no) {
  std::vector<Scalar> result;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const Scalar test = convert(tests[i], Type::Logical);
    if (test.missing) {
      result.push_back(missing_logical());
    } else {
      result.push_back(test.number != 0 ? yes[i % yes.size()] : no[i % no.size()]);
    }
  }
  return Values(std::move(result));
}

/// Every operation except Constant, Parameter and In, on evaluated operands.
Values apply_operation(Operation operation, const std::vector<Values>& parts) {
  if (operation == Operation::Combine) return combine(parts);
  if (operation == Operation::Min || operation == Operation::Max) return extreme(operation, parts);
  if (operation == Operation::Range) return range(parts[0], parts[1]);
  if (operation == Operation::IfElse) return choose(parts[0], parts[1], parts[2]);
  if (parts.size() == 1) {
    return elementwise(parts[0], missing_logical(),
                       [operation](const Scalar& x, const Scalar&) { return unary(operation, x); });
  }
  return elementwise(parts[0], parts[1], [operation](const Scalar& x, const Scalar& y) {
    return binary(operation, x, y);
  });
}

}  // namespace

Values Expression::evaluate(std::span<const Scalar> parameters) const {
  if (const Scalar* value = single(parameters)) return *value;
  if (operation_ == Operation::In) return evaluate_in(parameters);
  if (operands_.size() == 2) {
    const Scalar* a = operands_[0].single(parameters);
    const Scalar* b = operands_[1].single(parameters);
    if (a != nullptr && b != nullptr && operation_ < Operation::Range) {
      return binary(operation_, *a, *b);
    }
  }
  std::vector<Values> parts;
  parts.reserve(operands_.size());
  for (const Expression& operand : operands_)
    parts.push_back(operand.evaluate(parameters));
  return apply_operation(operation_, parts);
}

const Scalar* Expression::single(std::span<const Scalar> parameters) const {
  if (operation_ == Operation::Constant) return &constant_;
  if (operation_ != Operation::Parameter) return nullptr;
  SWARMSMITH_ASSERT(index_ >= 0, "an expression is bound before it is evaluated");
  return &parameters[static_cast<std::size_t>(index_)];
}

Values Expression::evaluate_in(std::span<const Scalar> parameters) const {
  const Scalar* x = operands_[0].single(parameters);
  if (x != nullptr && operands_[1].is_list_of_constants_) {
    for (const Expression& value : operands_[1].operands_) {
      if (matches(*x, value.constant_)) return Scalar::logical(true);
    }
    return Scalar::logical(false);
  }
  if (operands_[1].operation_ == Operation::Range) {
    const std::span<const Expression> ends = operands_[1].operands_;
    const auto numbers = sequence(ends[0].evaluate(parameters), ends[1].evaluate(parameters));
    if (!numbers) return Scalar::logical(false);
    return elementwise(operands_[0].evaluate(parameters), missing_logical(),
                       [&numbers](const Scalar& element, const Scalar&) {
                         return is_in_sequence(element, *numbers);
                       });
  }
  const Values table = operands_[1].evaluate(parameters);
  const Values elements = operands_[0].evaluate(parameters);
  if (table.size() > 1 || elements.size() > 1) return find_each(elements, table);
  return Scalar::logical(matches(elements[0], table[0]));
}

}  // namespace swarmsmith
