#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// One value of the expression language, which is R's: a type, and either a value or "missing" (R's
/// NA; a NaN counts as missing too). Integers are stored in the double: exact up to 2^53.
struct Scalar {
  enum class Type { Logical, Integer, Real, Text };  // in the order in which c() coerces

  Type type = Type::Logical;
  bool missing = true;
  double number = 0;  ///< 0 or 1 for logicals; unused for texts
  std::string text;   ///< only for texts

  static Scalar logical(bool value) { return {Type::Logical, false, value ? 1.0 : 0.0, {}}; }
  static Scalar integer(double value);
  static Scalar real(double value);
  static Scalar of_text(std::string value) { return {Type::Text, false, 0, std::move(value)}; }
  static Scalar missing_of(Type type) { return {type, true, 0, {}}; }

  friend bool operator==(const Scalar&, const Scalar&) = default;
};

/// A vector of scalars of one type. Nearly all have length one, and such a vector allocates no
/// memory.
class Values {
 public:
  Values(Scalar one) : one_(std::move(one)) {}  // NOLINT: a scalar is a vector of length one
  explicit Values(std::vector<Scalar> many);

  std::size_t size() const { return many_.empty() ? 1 : many_.size(); }
  const Scalar& operator[](std::size_t i) const { return many_.empty() ? one_ : many_[i]; }
  /// The type of all elements.
  Scalar::Type type() const { return (*this)[0].type; }

 private:
  Scalar one_;
  std::vector<Scalar> many_;  ///< empty for length one
};

/// The operation of a node of an expression. The groups are: leaves; logic; comparisons and %in%;
/// arithmetic; c() and conversions; functions. The code relies on the order of the groups.
enum class Operation {
  Constant,
  Parameter,
  Not,
  And,
  Or,
  Xor,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  In,
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,
  Modulo,
  IntegerDivide,
  Negate,
  Range,
  Combine,
  AsNumeric,
  AsInteger,
  AsText,
  IsMissing,
  IfElse,
  Min,
  Max,
  Round,
  Floor,
  Ceiling,
  Truncate,
  Abs,
  SquareRoot,
  Exp,
  Log,
};

/// from:to lists fewer numbers than this; a longer range gives a missing value, except in `x %in%
/// from:to`, which needs no list.
inline constexpr double kLongestRange = 10'000;

/// The number of operands that an operation takes.
struct Arity {
  std::size_t least;
  std::size_t most;
};
Arity arity(Operation operation);

/// An expression over parameters, as in conditions, forbidden clauses and dependent bounds: a
/// syntax tree with the three-valued logic and the coercions of R. Where R reports an error
/// (arithmetic on texts, logic on texts), the value is missing here. Texts are ordered first
/// without regard to case (punctuation, then digits, then letters), then lower case before upper,
/// in every locale.
///
/// A tree is built by these functions or by a parser, bound to a parameter space once, and then
/// evaluated many times.
class Expression {
 public:
  static Expression number(double value) { return constant(Scalar::real(value)); }
  static Expression integer(std::int32_t value) { return constant(Scalar::integer(value)); }
  static Expression text(std::string value) { return constant(Scalar::of_text(std::move(value))); }
  static Expression logical(bool value) { return constant(Scalar::logical(value)); }
  static Expression missing() { return constant(Scalar{}); }
  static Expression constant(Scalar value);
  static Expression parameter(std::string name);
  /// Throws std::invalid_argument when the number of operands does not fit the operation.
  static Expression call(Operation operation, std::vector<Expression> operands);
  /// `x %in% c(values...)`.
  static Expression in(Expression x, std::vector<Expression> values);

  Operation operation() const { return operation_; }
  std::span<const Expression> operands() const { return operands_; }
  /// The name of a parameter node; empty for others.
  const std::string& name() const { return name_; }
  /// The index of a parameter node once it is bound; -1 before.
  int parameter_index() const { return index_; }

  /// Names of all parameters that the expression mentions, each once, in order of appearance.
  std::vector<std::string> names() const;
  /// Gives every parameter node the index of its name in `names`; an unknown name is an error.
  Expected<void> bind(std::span<const std::string> names);

  /// The value of the expression. `parameters` has the value of each parameter by index (missing
  /// when inactive). The expression must be bound.
  Values evaluate(std::span<const Scalar> parameters) const;
  /// Whether the value is TRUE. It is false for FALSE, a missing value, a number and a vector
  /// longer than one.
  bool is_true(std::span<const Scalar> parameters) const;
  /// The value as a number; nothing when it is missing or not a single number.
  std::optional<double> to_number(std::span<const Scalar> parameters) const;

  /// Whether both are the same tree over the same names, bound or not.
  friend bool operator==(const Expression& a, const Expression& b);

 private:
  Expression() = default;

  void collect_names(std::vector<std::string>& names) const;
  /// The value of a constant or parameter without a copy; null for every other node.
  const Scalar* single(std::span<const Scalar> parameters) const;
  Values evaluate_in(std::span<const Scalar> parameters) const;

  Operation operation_ = Operation::Constant;
  /// A Combine of constants of one type, which needs no evaluation.
  bool is_list_of_constants_ = false;
  int index_ = -1;
  std::string name_;
  Scalar constant_;
  std::vector<Expression> operands_;
};

/// Negative, zero or positive if `a` sorts before, equal to or after `b`, in the order described
/// above.
int compare_texts(std::string_view a, std::string_view b);

/// Like R's as.character: at most 15 significant digits, and the shorter of fixed and scientific
/// notation for reals (100000 is "1e+05"), integers in full; TRUE and FALSE; "NA" when missing.
std::string to_text(const Scalar& value);

/// A number as it is written on a command line: at most 15 significant digits, never in scientific
/// notation, no trailing zeros.
std::string to_fixed_text(double value);

/// The shortest digits from which the same number is read back, never in scientific notation: for
/// messages that compare numbers.
std::string exact_text(double value);

}  // namespace swarmsmith
