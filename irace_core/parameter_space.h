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

/// The values have no order.
struct Categorical {
  std::vector<std::string> values;

  friend bool operator==(const Categorical&, const Categorical&) = default;
};

/// The values are ordered as listed.
struct Ordinal {
  std::vector<std::string> values;

  friend bool operator==(const Ordinal&, const Ordinal&) = default;
};

/// One end of a numeric domain: a constant, or an expression of other numeric parameters
/// ("dependent domain"), which is evaluated only when the parameter is active.
using Bound = std::variant<double, Expression>;

/// Whole numbers from `lower` to `upper`, both included; computed bounds are truncated. With `log`
/// the parameter is sampled on a logarithmic scale.
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

/// One parameter of the target: its name, type, domain and condition.
struct Parameter {
  std::string name;
  std::string switch_text;  ///< printed before the value on a command line, for instance "--alpha "
  Domain domain;
  /// Active only if this is TRUE; without a condition always active.
  std::optional<Expression> condition;

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// The ends of a numeric domain in one configuration.
struct Interval {
  double lower;
  double upper;

  friend bool operator==(const Interval&, const Interval&) = default;
};

class Assignment;

/// The parameters that are tuned, in declaration order, and the forbidden configurations. A space
/// is checked when it is made.
class ParameterSpace {
 public:
  /// An empty space, to be assigned to later.
  ParameterSpace() = default;
  /// Checks names and domains, and that no reference is unknown or circular; `where` of an error is
  /// the parameter's name. A bound that mentions no parameter is evaluated at once. `digits`:
  /// decimals of reals.
  static Expected<ParameterSpace> make(std::vector<Parameter> parameters,
                                       std::vector<Expression> forbidden = {}, int digits = 4);

  std::size_t size() const { return parameters_.size(); }
  const Parameter& operator[](std::size_t index) const { return parameters_[index]; }
  std::span<const Parameter> parameters() const { return parameters_; }
  std::span<const Expression> forbidden() const { return forbidden_; }
  int digits() const { return digits_; }
  std::optional<std::size_t> index_of(std::string_view name) const;

  /// The parameters in an order in which each comes after those that its condition and domain
  /// mention: a stable sort by level.
  std::span<const std::size_t> hierarchy_order() const { return order_; }
  /// 1 for a parameter that depends on no other; otherwise one more than the highest level among
  /// the parameters that it depends on.
  int level(std::size_t index) const { return levels_[index]; }
  /// A parameter with a single value is never sampled and does not count as variable.
  bool is_fixed(std::size_t index) const { return value_count(index) == 1; }
  /// The number of parameters that are not fixed: d in all formulae.
  int variable_count() const { return variable_count_; }
  /// Number of values of a categorical or ordinal parameter; 0 for numeric ones.
  std::size_t value_count(std::size_t index) const;
  bool is_numeric(std::size_t index) const { return value_count(index) == 0; }
  /// The domain of a numeric parameter with constant bounds; null for a dependent domain.
  const Interval* constant_interval(std::size_t index) const {
    return intervals_[index] ? &*intervals_[index] : nullptr;
  }

  /// The value as conditions see it: a text for categorical and ordinal parameters, missing when
  /// inactive.
  Scalar scalar(std::size_t index, double value) const;

  /// Whether a parameter's condition holds, given the values of the parameters before it in
  /// hierarchy order.
  bool is_active(std::size_t index, const Assignment& values) const;
  /// The domain of a numeric parameter; nothing when a parameter that a bound mentions is inactive.
  /// A lower bound above the upper one is an error that names the parameter.
  Expected<std::optional<Interval>> interval(std::size_t index, const Assignment& values) const;
  bool is_forbidden(const Configuration& configuration) const;

  /// Whether every active parameter has a value of its domain and every inactive one has none.
  /// Forbidden clauses are not checked.
  Expected<void> check(const Configuration& configuration) const;

 private:
  friend class Assignment;

  /// A condition that mentions only one categorical, ordinal or integer parameter, evaluated in
  /// advance for each of its values.
  struct ConditionTable {
    std::size_t parameter;
    double first;  ///< the parameter value of the first entry in `holds`
    std::vector<bool> holds;
    bool holds_when_inactive;
  };

  /// Tabulates the conditions for which this is possible, and marks the parameters that the other
  /// expressions read.
  void prepare_conditions();
  void mark_as_read(const Expression& expression);
  /// Returns nothing if the condition mentions several parameters, a real, or an integer with a
  /// wide domain.
  std::optional<ConditionTable> tabulate(const Expression& condition) const;

  std::vector<Parameter> parameters_;
  std::vector<Expression> forbidden_;
  int digits_ = 4;
  std::vector<std::size_t> order_;
  std::vector<int> levels_;
  int variable_count_ = 0;
  /// By parameter: the domain of a numeric parameter with constant bounds; an empty interval for
  /// categorical and ordinal parameters.
  std::vector<std::optional<Interval>> intervals_;
  std::vector<std::vector<Scalar>> choices_;  ///< the values of categorical and ordinal parameters
  std::vector<std::optional<ConditionTable>> tables_;
  /// By parameter: whether an expression that is not tabulated reads it.
  std::vector<bool> is_read_;
  /// The value of each parameter, as conditions see it, while it is inactive.
  std::vector<Scalar> inactive_;
};

/// A configuration that is filled in parameter by parameter, together with its values as conditions
/// see them.
class Assignment {
 public:
  /// Starts with all parameters inactive; `space` must outlive the assignment.
  explicit Assignment(const ParameterSpace& space);
  Assignment(const ParameterSpace& space, const Configuration& configuration);

  void set(std::size_t parameter, double value);
  const Configuration& configuration() const { return configuration_; }
  /// By parameter. Only the entries that some expression reads are up to date.
  std::span<const Scalar> scalars() const { return scalars_; }

 private:
  const ParameterSpace* space_;
  Configuration configuration_;
  std::vector<Scalar> scalars_;
};

/// A configuration in which every active parameter is drawn uniformly from its domain. Fails when a
/// dependent domain is empty.
Expected<Configuration> sample_uniform(const ParameterSpace& space, Rng& rng);

}  // namespace swarmsmith
