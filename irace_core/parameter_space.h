#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "base/rng.h"
#include "irace_core/configuration.h"
#include "irace_core/expression.h"

namespace swarmsmith {

/// Unordered values.
struct Categorical {
  std::vector<std::string> values;

  friend bool operator==(const Categorical&, const Categorical&) = default;
};

/// Ordered values.
struct Ordinal {
  std::vector<std::string> values;

  friend bool operator==(const Ordinal&, const Ordinal&) = default;
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

  friend bool operator==(const Integer&, const Integer&) = default;
};

/// Reals from `lower` to `upper`, rounded to the digits of the space.
struct Real {
  Bound lower;
  Bound upper;
  bool log = false;

  friend bool operator==(const Real&, const Real&) = default;
};

using Domain = std::variant<Categorical, Ordinal, Integer, Real>;

/// One typed variable of what is tuned.
struct Parameter {
  std::string name;
  std::string switch_text;  ///< stands before the value on a command line, for instance "--alpha "
  Domain domain;
  std::optional<Expression> condition;  ///< active only where this is TRUE; always, without one

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// The ends of a numeric domain in one configuration.
struct Interval {
  double lower;
  double upper;

  friend bool operator==(const Interval&, const Interval&) = default;
};

class Assignment;

/// The parameters that are tuned, in declaration order, and what must not be tried: a checked
/// value.
class ParameterSpace {
 public:
  /// Without parameters: only to be assigned to.
  ParameterSpace() = default;
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
  /// The domain of a numeric parameter with constant bounds; null for a dependent domain.
  const Interval* constant_interval(std::size_t index) const {
    return intervals_[index] ? &*intervals_[index] : nullptr;
  }

  /// The value as conditions see it: choices are texts, inactive is missing.
  Scalar scalar(std::size_t index, double value) const;

  /// Whether a parameter's condition holds, given those before it in hierarchy order.
  bool is_active(std::size_t index, const Assignment& values) const;
  /// The domain of a numeric parameter, which nothing has when a parameter in a bound is inactive.
  /// Lower above upper is an error that names the parameter.
  Expected<std::optional<Interval>> interval(std::size_t index, const Assignment& values) const;
  bool is_forbidden(const Configuration& configuration) const;

  /// Whether every active parameter has a value of its domain and every other has none. Forbidden
  /// clauses are not looked at.
  Expected<void> check(const Configuration& configuration) const;

 private:
  friend class Assignment;

  /// A condition on one choice or integer, worked out for each of its values.
  struct ConditionTable {
    std::size_t parameter;
    double first;  ///< the value that the first entry belongs to
    std::vector<bool> holds;
    bool holds_when_inactive;
  };

  /// Tabulates what can be, and notes what the other expressions read.
  void prepare_conditions();
  void mark_as_read(const Expression& expression);
  /// Nothing when the condition mentions several parameters, a real or a wide integer.
  std::optional<ConditionTable> tabulate(const Expression& condition) const;

  std::vector<Parameter> parameters_;
  std::vector<Expression> forbidden_;
  int digits_ = 4;
  std::vector<std::size_t> order_;
  std::vector<int> levels_;
  int variable_count_ = 0;
  /// Constant domains of numeric parameters; those of choices are empty intervals.
  std::vector<std::optional<Interval>> intervals_;
  std::vector<std::vector<Scalar>> choices_;  ///< the values of categorical and ordinal parameters
  std::vector<std::optional<ConditionTable>> tables_;
  std::vector<bool> is_read_;     ///< by expressions that are not tabulated
  std::vector<Scalar> inactive_;  ///< all parameters as conditions see them when none is active
};

/// A configuration that is filled parameter by parameter, together with its values as conditions
/// see them.
class Assignment {
 public:
  /// All inactive; `space` must outlive the assignment.
  explicit Assignment(const ParameterSpace& space);
  Assignment(const ParameterSpace& space, const Configuration& configuration);

  void set(std::size_t parameter, double value);
  const Configuration& configuration() const { return configuration_; }
  /// By parameter. Up to date for those that some expression reads.
  std::span<const Scalar> scalars() const { return scalars_; }

 private:
  const ParameterSpace* space_;
  Configuration configuration_;
  std::vector<Scalar> scalars_;
};

/// A configuration with every active parameter uniform in its domain. Fails when a domain that
/// depends on other parameters is empty.
Expected<Configuration> sample_uniform(const ParameterSpace& space, Rng& rng);

}  // namespace swarmsmith
