#include "irace_core/parameter_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/plain_text.h"
#include "irace_core/internal/check_parameter.h"

namespace swarmsmith {
namespace {

/// The names of the parameters that the condition and the bounds of a parameter mention.
std::vector<std::string> dependencies(const Parameter& parameter) {
  std::vector<std::string> names;
  const auto add = [&names](const Expression& expression) {
    for (std::string& name : expression.names())
      names.push_back(std::move(name));
  };
  if (parameter.condition) add(*parameter.condition);
  for (const Expression* bound : irace::bound_expressions(parameter.domain))
    add(*bound);
  return names;
}

/// Levels by repeated relaxation; the error names the first parameter that depends on itself.
Expected<std::vector<int>> find_levels(const std::vector<std::vector<std::size_t>>& depends_on,
                                       std::span<const std::string> names) {
  const std::size_t n = depends_on.size();
  std::vector<int> levels(n, 1);
  // irace facts, 8.1: one level above the highest parameter that is mentioned. A chain has at most
  // n parameters, so only a cycle changes a level in each of n + 1 rounds.
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
  // A parameter that depends on a cycle without being part of it has a higher level than the
  // members of the cycle at some point, so we follow the dependencies until one parameter occurs
  // twice.
  std::vector<bool> seen(n, false);
  auto at =
      static_cast<std::size_t>(std::max_element(levels.begin(), levels.end()) - levels.begin());
  while (!seen[at]) {
    seen[at] = true;
    at = *std::max_element(
        depends_on[at].begin(), depends_on[at].end(),
        [&levels](std::size_t a, std::size_t b) { return levels[a] < levels[b]; });
  }
  return bad_input("depends on itself, by its condition or domain or through other parameters",
                   names[at]);
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
  return find_levels(depends_on, names);
}

/// Whether the expression lists a range of numbers, which may take long.
bool has_list(const Expression& expression) {
  const auto operands = expression.operands();
  const bool searched =
      expression.operation() == Operation::In && operands[1].operation() == Operation::Range;
  if (expression.operation() == Operation::Range) return true;
  // `x %in% a:b` needs no list (see kLongestRange).
  if (searched) return has_list(operands[0]);
  return std::any_of(operands.begin(), operands.end(), has_list);
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
      Error error = checked.error();
      // One error gives the digits that all bounds need: otherwise the user would repeat this for
      // each bound.
      const std::string all =
          "digits = " + std::to_string(irace::digits_needed(parameters, digits));
      const bool is_of_digits = error.message.find("it needs digits") != std::string::npos;
      if (is_of_digits && !error.message.ends_with(all)) {
        error.message += ", and another bound " + all;
      }
      return Unexpected(std::move(error));
    }
    space.intervals_.push_back(irace::constant_interval(parameter.domain));
    std::vector<Scalar>& choices = space.choices_.emplace_back();
    for (const std::string& value : irace::choice_values(parameter.domain)) {
      choices.push_back(Scalar::of_text(value));
    }
    // irace facts, 1: parameters with one value do not count in d.
    if (choices.size() != 1) ++space.variable_count_;
  }
  if (space.variable_count_ == 0)
    return bad_input("every parameter has a single value: there is nothing to choose from");
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
  // irace facts, 8.1: sampling follows the levels, and within a level the order of declaration.
  std::stable_sort(space.order_.begin(), space.order_.end(), [&](std::size_t a, std::size_t b) {
    return space.levels_[a] < space.levels_[b];
  });
  space.parameters_ = std::move(parameters);
  space.forbidden_ = std::move(forbidden);
  space.digits_ = digits;
  space.prepare_conditions();
  return space;
}

void ParameterSpace::prepare_conditions() {
  is_read_.assign(size(), false);
  for (std::size_t i = 0; i < size(); ++i)
    inactive_.push_back(scalar(i, std::nan("")));
  for (const Parameter& parameter : parameters_) {
    std::optional<ConditionTable>& table = tables_.emplace_back();
    if (parameter.condition) {
      table = tabulate(*parameter.condition);
      if (!table) mark_as_read(*parameter.condition);
    }
    for (const Expression* bound : irace::bound_expressions(parameter.domain))
      mark_as_read(*bound);
  }
  for (const Expression& clause : forbidden_)
    mark_as_read(clause);
}

void ParameterSpace::mark_as_read(const Expression& expression) {
  for (const std::string& name : expression.names())
    is_read_[*index_of(name)] = true;
}

std::optional<ParameterSpace::ConditionTable> ParameterSpace::tabulate(
    const Expression& condition) const {
  // A limit for the size of tables. Conditions on wider domains are evaluated each time.
  constexpr double kMostValues = 1000;
  const std::vector<std::string> names = condition.names();
  if (names.size() != 1 || has_list(condition)) return std::nullopt;
  const std::size_t index = *index_of(names.front());
  ConditionTable table{index, 0, {}, condition.is_true(inactive_)};
  std::size_t count = value_count(index);
  if (is_numeric(index)) {
    const Interval* domain = constant_interval(index);
    const bool whole = std::holds_alternative<Integer>(parameters_[index].domain);
    if (!whole || domain == nullptr || domain->upper - domain->lower >= kMostValues) {
      return std::nullopt;
    }
    table.first = domain->lower;
    count = static_cast<std::size_t>(domain->upper - domain->lower) + 1;
  }
  std::vector<Scalar> values = inactive_;
  for (std::size_t i = 0; i < count; ++i) {
    values[index] = scalar(index, table.first + static_cast<double>(i));
    table.holds.push_back(condition.is_true(values));
  }
  return table;
}

std::optional<std::size_t> ParameterSpace::index_of(std::string_view name) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (parameters_[i].name == name) return i;
  }
  return std::nullopt;
}

std::size_t ParameterSpace::value_count(std::size_t index) const {
  return choices_[index].size();
}

Scalar ParameterSpace::scalar(std::size_t index, double value) const {
  if (!choices_[index].empty()) {
    // irace facts, 8.2: conditions see values of categorical and ordinal parameters as texts, and
    // NA where a parameter is inactive.
    if (value != value) return Scalar::missing_of(Scalar::Type::Text);
    return choices_[index][static_cast<std::size_t>(value)];
  }
  const bool whole = std::holds_alternative<Integer>(parameters_[index].domain);
  return whole ? Scalar::integer(value) : Scalar::real(value);
}

bool ParameterSpace::is_active(std::size_t index, const Assignment& values) const {
  const std::optional<Expression>& condition = parameters_[index].condition;
  if (!condition) return true;
  const std::optional<ConditionTable>& table = tables_[index];
  if (!table) return condition->is_true(values.scalars());
  const Configuration& known = values.configuration();
  if (!known.is_active(table->parameter)) return table->holds_when_inactive;
  return table->holds[static_cast<std::size_t>(known[table->parameter] - table->first)];
}

Expected<std::optional<Interval>> ParameterSpace::interval(std::size_t index,
                                                           const Assignment& values) const {
  if (intervals_[index]) return intervals_[index];
  const auto evaluate = [&](const auto& domain) -> std::optional<Interval> {
    const auto number = [&](const Bound& bound) -> std::optional<double> {
      if (const double* constant = std::get_if<double>(&bound)) return *constant;
      return std::get<Expression>(bound).to_number(values.scalars());
    };
    const std::optional<double> lower = number(domain.lower);
    const std::optional<double> upper = number(domain.upper);
    // irace facts, 8.3: a bound that is NA makes the parameter NA.
    if (!lower || !upper) return std::nullopt;
    return Interval{*lower, *upper};
  };
  std::optional<Interval> found;
  if (const auto* whole = std::get_if<Integer>(&parameters_[index].domain)) {
    found = evaluate(*whole);
    // irace facts, 8.3: computed bounds of integers are truncated towards zero.
    if (found) found = Interval{std::trunc(found->lower), std::trunc(found->upper)};
    for (const double bound : {found ? found->lower : 0, found ? found->upper : 0}) {
      if (auto fits = irace::check_whole(bound, parameters_[index].name); !fits)
        return Unexpected(fits.error());
    }
  } else {
    found = evaluate(std::get<Real>(parameters_[index].domain));
    for (const double bound : {found ? found->lower : 0, found ? found->upper : 0}) {
      if (std::isinf(bound)) {
        return bad_input(
            "a bound of its domain is infinite here: keep it finite, as by min() and max()",
            parameters_[index].name);
      }
    }
  }
  // irace facts, 8.3: equal bounds are allowed, an empty domain is an error.
  if (found && found->lower > found->upper) {
    return bad_input("the domain (" + exact_text(found->lower) + ", " + exact_text(found->upper) +
                         ") is empty here: keep the bounds apart, as by min() and max()",
                     parameters_[index].name);
  }
  return found;
}

/// irace facts, 8.4: a clause forbids only if it is TRUE, not if it is NA.
bool ParameterSpace::is_forbidden(const Configuration& configuration) const {
  if (forbidden_.empty()) return false;
  const Assignment values(*this, configuration);
  return std::any_of(forbidden_.begin(), forbidden_.end(),
                     [&](const Expression& clause) { return clause.is_true(values.scalars()); });
}

Expected<void> ParameterSpace::check(const Configuration& configuration) const {
  if (configuration.size() != size()) {
    return bad_input("a configuration has " + counted(configuration.size(), "value") +
                     ", the space " + counted(size(), "parameter"));
  }
  Assignment values(*this);
  // In hierarchy order: conditions and domains then see only values that were checked.
  for (const std::size_t i : order_) {
    const std::string& name = parameters_[i].name;
    auto domain = Expected<std::optional<Interval>>(std::nullopt);
    if (is_active(i, values)) {
      domain = is_numeric(i) ? interval(i, values)
                             : Interval{0, static_cast<double>(value_count(i)) - 1};
    }
    if (!domain) return Unexpected(domain.error());
    const double v = configuration[i];
    if (!*domain && configuration.is_active(i))
      return bad_input("is inactive but has a value", name);
    if (!*domain) continue;
    if (!configuration.is_active(i)) return bad_input("is active and needs a value", name);
    if (v < (*domain)->lower || v > (*domain)->upper) {
      return bad_input(exact_text(v) + " is not in its domain (" + exact_text((*domain)->lower) +
                           ", " + exact_text((*domain)->upper) + ")",
                       name);
    }
    if (!std::holds_alternative<Real>(parameters_[i].domain) && v != std::floor(v)) {
      return bad_input(exact_text(v) + " is not a whole number", name);
    }
    values.set(i, v);
  }
  return {};
}

Assignment::Assignment(const ParameterSpace& space)
    : space_(&space), configuration_(space.size()), scalars_(space.inactive_) {}

Assignment::Assignment(const ParameterSpace& space, const Configuration& configuration)
    : Assignment(space) {
  for (std::size_t i = 0; i < space.size(); ++i)
    set(i, configuration[i]);
}

void Assignment::set(std::size_t parameter, double value) {
  configuration_.set(parameter, value);
  // Tabulated conditions read the configuration, so that the other values need no conversion.
  if (space_->is_read_[parameter]) scalars_[parameter] = space_->scalar(parameter, value);
}

}  // namespace swarmsmith
