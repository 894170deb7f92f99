#include "irace_core/parameter_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/overloaded.h"
#include "irace_core/internal/check_parameter.h"

namespace swarmsmith {
namespace {

/// Names that the condition and the bounds of a parameter mention.
std::vector<std::string> dependencies(const Parameter& parameter) {
  std::vector<std::string> names;
  const auto add = [&names](const Expression& expression) {
    for (std::string& name : expression.names()) names.push_back(std::move(name));
  };
  if (parameter.condition) add(*parameter.condition);
  for (const Expression* bound : irace::bound_expressions(parameter.domain)) add(*bound);
  return names;
}

/// Levels by repeated relaxation; an empty result means that there is a cycle.
std::vector<int> find_levels(const std::vector<std::vector<std::size_t>>& depends_on) {
  const std::size_t n = depends_on.size();
  std::vector<int> levels(n, 1);
  for (std::size_t round = 0; round <= n; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      for (const std::size_t other : depends_on[i]) {
        if (levels[i] > levels[other]) continue;
        levels[i] = levels[other] + 1;
        changed = true;
      }
    }
    if (!changed) return levels;
  }
  return {};
}

Expected<std::vector<int>> hierarchy(std::span<const Parameter> parameters,
                                     std::span<const std::string> names) {
  std::vector<std::vector<std::size_t>> depends_on;
  for (const Parameter& parameter : parameters) {
    std::vector<std::size_t>& mine = depends_on.emplace_back();
    for (const std::string& name : dependencies(parameter)) {
      const auto found = std::find(names.begin(), names.end(), name);
      mine.push_back(static_cast<std::size_t>(found - names.begin()));
    }
  }
  std::vector<int> levels = find_levels(depends_on);
  if (levels.empty()) return bad_input("parameters depend on each other in a circle");
  return levels;
}

}  // namespace

Expected<ParameterSpace> ParameterSpace::make(std::vector<Parameter> parameters,
                                              std::vector<Expression> forbidden, int digits) {
  if (parameters.empty()) return bad_input("a parameter space needs a parameter");
  if (digits < 1 || digits > 15) return bad_input("digits must lie in 1..15", "digits");
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) {
    if (std::find(names.begin(), names.end(), parameter.name) != names.end()) {
      return bad_input("the name occurs twice", parameter.name);
    }
    names.push_back(parameter.name);
  }
  ParameterSpace space;
  for (Parameter& parameter : parameters) {
    if (auto bound = irace::bind_parameter(parameter, names, parameters); !bound) {
      return Unexpected(bound.error());
    }
    if (auto checked = irace::check_parameter(parameter, digits); !checked) {
      return Unexpected(checked.error());
    }
    space.intervals_.push_back(irace::constant_interval(parameter.domain));
    std::vector<Scalar>& choices = space.choices_.emplace_back();
    for (const std::string& value : irace::choice_values(parameter.domain)) {
      choices.push_back(Scalar::of_text(value));
    }
    if (choices.size() != 1) ++space.variable_count_;
  }
  if (space.variable_count_ == 0) return bad_input("every parameter has a single value");
  for (Expression& clause : forbidden) {
    if (auto bound = clause.bind(names); !bound) {
      return bad_input(bound.error().message, "forbidden");
    }
  }
  auto levels = hierarchy(parameters, names);
  if (!levels) return Unexpected(levels.error());
  space.levels_ = std::move(*levels);
  space.order_.resize(parameters.size());
  std::iota(space.order_.begin(), space.order_.end(), std::size_t{0});
  std::stable_sort(space.order_.begin(), space.order_.end(), [&](std::size_t a, std::size_t b) {
    return space.levels_[a] < space.levels_[b];
  });
  space.parameters_ = std::move(parameters);
  space.forbidden_ = std::move(forbidden);
  space.digits_ = digits;
  return space;
}

std::optional<std::size_t> ParameterSpace::index_of(std::string_view name) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (parameters_[i].name == name) return i;
  }
  return std::nullopt;
}

std::size_t ParameterSpace::value_count(std::size_t index) const { return choices_[index].size(); }

Scalar ParameterSpace::scalar(std::size_t index, double value) const {
  if (!choices_[index].empty()) {
    if (value != value) return Scalar::missing_of(Scalar::Type::Text);
    return choices_[index][static_cast<std::size_t>(value)];
  }
  const bool whole = std::holds_alternative<Integer>(parameters_[index].domain);
  return whole ? Scalar::integer(value) : Scalar::real(value);
}

std::vector<Scalar> ParameterSpace::scalars(const Configuration& configuration) const {
  std::vector<Scalar> values;
  values.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) values.push_back(scalar(i, configuration[i]));
  return values;
}

bool ParameterSpace::is_active(std::size_t index, std::span<const Scalar> values) const {
  const std::optional<Expression>& condition = parameters_[index].condition;
  return !condition || condition->is_true(values);
}

Expected<std::optional<Interval>> ParameterSpace::interval(std::size_t index,
                                                           std::span<const Scalar> values) const {
  if (intervals_[index]) return intervals_[index];
  const auto evaluate = [&](const auto& domain) -> std::optional<Interval> {
    const auto number = [&](const Bound& bound) -> std::optional<double> {
      if (const double* constant = std::get_if<double>(&bound)) return *constant;
      return std::get<Expression>(bound).to_number(values);
    };
    const std::optional<double> lower = number(domain.lower);
    const std::optional<double> upper = number(domain.upper);
    if (!lower || !upper) return std::nullopt;
    return Interval{*lower, *upper};
  };
  std::optional<Interval> found;
  if (const auto* whole = std::get_if<Integer>(&parameters_[index].domain)) {
    found = evaluate(*whole);
    if (found) found = Interval{std::trunc(found->lower), std::trunc(found->upper)};
  } else {
    found = evaluate(std::get<Real>(parameters_[index].domain));
  }
  if (found && found->lower > found->upper) {
    return bad_input("the domain (" + to_fixed_text(found->lower) + ", " +
                         to_fixed_text(found->upper) + ") is empty here",
                     parameters_[index].name);
  }
  return found;
}

bool ParameterSpace::is_forbidden(std::span<const Scalar> values) const {
  return std::any_of(forbidden_.begin(), forbidden_.end(),
                     [&](const Expression& clause) { return clause.is_true(values); });
}

Expected<void> ParameterSpace::check(const Configuration& configuration) const {
  if (configuration.size() != size()) {
    return bad_input("a configuration has " + std::to_string(configuration.size()) +
                     " values, the space " + std::to_string(size()) + " parameters");
  }
  for (std::size_t i = 0; i < size(); ++i) {
    const double v = configuration[i];
    const bool choice = !is_numeric(i);
    const bool outside = choice && !(v >= 0 && v < static_cast<double>(value_count(i)));
    if (configuration.is_active(i) && choice && (outside || v != std::floor(v))) {
      return bad_input("there is no value number " + to_fixed_text(v), parameters_[i].name);
    }
  }
  const std::vector<Scalar> values = scalars(configuration);
  for (const std::size_t i : order_) {
    const std::string& name = parameters_[i].name;
    std::optional<Interval> domain = Interval{0, 0};
    bool active = is_active(i, values);
    if (active && is_numeric(i)) {
      auto found = interval(i, values);
      if (!found) return Unexpected(found.error());
      domain = *found;
      active = domain.has_value();
    }
    if (active && !configuration.is_active(i)) return bad_input("is active and needs a value", name);
    if (!active && configuration.is_active(i)) return bad_input("is inactive but has a value", name);
    if (!active || !is_numeric(i)) continue;
    const double v = configuration[i];
    if (v < domain->lower || v > domain->upper) {
      return bad_input(to_fixed_text(v) + " is not in its domain (" + to_fixed_text(domain->lower) +
                           ", " + to_fixed_text(domain->upper) + ")",
                       name);
    }
    if (std::holds_alternative<Integer>(parameters_[i].domain) && v != std::floor(v)) {
      return bad_input(to_fixed_text(v) + " is not a whole number", name);
    }
  }
  return {};
}

}  // namespace swarmsmith
