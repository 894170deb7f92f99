#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/expression.h"

namespace swarmsmith {

/// Unordered values.
struct Categorical {
  std::vector<std::string> values;
};

/// Ordered values.
struct Ordinal {
  std::vector<std::string> values;
};

/// End of a numeric domain: a constant, or an expression of other numeric parameters ("dependent
/// domain"), which is evaluated only where the parameter is active.
using Bound = std::variant<double, Expression>;

/// Whole numbers from `lower` to `upper`, both included; computed bounds are truncated. With `log`
/// sampled uniformly in the logarithm.
struct Integer {
  Bound lower;
  Bound upper;
  bool log = false;
};

/// Reals from `lower` to `upper`, rounded to the digits of the space.
struct Real {
  Bound lower;
  Bound upper;
  bool log = false;
};

using Domain = std::variant<Categorical, Ordinal, Integer, Real>;

/// One typed variable of what is tuned.
struct Parameter {
  std::string name;
  std::string switch_text;  ///< stands before the value on a command line, for instance "--alpha "
  Domain domain;
  std::optional<Expression> condition;  ///< active only where this is TRUE; always, without one
};

/// The ends of a numeric domain in one configuration.
struct Interval {
  double lower;
  double upper;

  friend bool operator==(const Interval&, const Interval&) = default;
};

/// The parameters that are tuned, in declaration order, and what must not be tried: a checked value.
class ParameterSpace {
 public:
  /// Checks names, domains, unknown and circular references; `where` of an error is the parameter's
  /// name. A bound without parameters in it is evaluated at once. `digits`: decimals of reals.
  static Expected<ParameterSpace> make(std::vector<Parameter> parameters,
                                       std::vector<Expression> forbidden = {}, int digits = 4);

  std::size_t size() const { return parameters_.size(); }
  const Parameter& operator[](std::size_t index) const { return parameters_[index]; }
  std::span<const Parameter> parameters() const { return parameters_; }
  std::span<const Expression> forbidden() const { return forbidden_; }
  int digits() const { return digits_; }
  std::optional<std::size_t> index_of(std::string_view name) const;

  /// Every parameter after those that its condition and domain mention: a stable sort by level.
  std::span<const std::size_t> hierarchy_order() const { return order_; }
  /// 1 for a parameter that depends on nothing, else one more than the deepest it depends on.
  int level(std::size_t index) const { return levels_[index]; }
  /// A single value: never sampled, not counted.
  bool is_fixed(std::size_t index) const { return value_count(index) == 1; }
  /// The d of all formulae: parameters that are not fixed.
  int variable_count() const { return variable_count_; }
  /// Number of values of a categorical or ordinal parameter; 0 for numeric ones.
  std::size_t value_count(std::size_t index) const;
  bool is_numeric(std::size_t index) const { return value_count(index) == 0; }
  bool has_dependent_domain(std::size_t index) const { return !intervals_[index].has_value(); }

  /// The value as conditions see it: choices are texts, inactive is missing.
  Scalar scalar(std::size_t index, double value) const;
  /// All values of a configuration as conditions see them.
  std::vector<Scalar> scalars(const Configuration& configuration) const;

  bool is_active(std::size_t index, std::span<const Scalar> values) const;
  /// The domain of a numeric parameter, which nothing has when a parameter in a bound is inactive.
  /// Lower above upper is an error that names the parameter.
  Expected<std::optional<Interval>> interval(std::size_t index,
                                             std::span<const Scalar> values) const;
  bool is_forbidden(std::span<const Scalar> values) const;

  /// Whether every active parameter has a value of its domain and every other has none. Forbidden
  /// clauses are not looked at.
  Expected<void> check(const Configuration& configuration) const;

 private:
  ParameterSpace() = default;

  std::vector<Parameter> parameters_;
  std::vector<Expression> forbidden_;
  int digits_ = 4;
  std::vector<std::size_t> order_;
  std::vector<int> levels_;
  int variable_count_ = 0;
  /// Constant domains of numeric parameters; those of choices are empty intervals.
  std::vector<std::optional<Interval>> intervals_;
  std::vector<std::vector<Scalar>> choices_;  ///< the values of categorical and ordinal parameters
};

}  // namespace swarmsmith
