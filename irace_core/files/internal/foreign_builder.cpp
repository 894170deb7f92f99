#include "irace_core/files/internal/foreign_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/suggestion.h"
#include "irace_core/files/number_text.h"
#include "irace_core/files/parameter_file.h"
#include "irace_core/internal/check_parameter.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::irace {
namespace {

constexpr int kMostDigits = 15;
constexpr int kRenamedTold = 3;  ///< reported one by one; there may be hundreds

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The name for irace: it begins with a letter, and characters that irace does not allow become
/// '_'.
std::string irace_name(const std::string& name) {
  std::string text = is_letter(name.front()) ? name : "p" + name;
  std::ranges::replace_if(
      text, [](char c) { return !is_letter(c) && !(c >= '0' && c <= '9') && c != '.'; }, '_');
  return text;
}

/// The number in the form that conditions of the parameter use.
Expected<Expression> number_constant(const Domain& domain, const std::string& text,
                                     const std::string& where) {
  const std::optional<double> number = number_of(text);
  if (!number) return bad_input("expected a number, found '" + text + "'", where);
  if (std::holds_alternative<Integer>(domain) && *number != std::floor(*number)) {
    return bad_input("expected a whole number, found '" + text + "'", where);
  }
  return Expression::number(*number);
}

Expected<std::size_t> position_of(std::span<const std::string> values, const std::string& text,
                                  const std::string& name, const std::string& where) {
  const auto found = std::ranges::find(values, text);
  if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
  return bad_input("'" + text + "' is not a value of '" + name + "': " + joined(values) +
                       did_you_mean(text, values),
                   where);
}

bool is_order(Operation operation) {
  return operation == Operation::Less || operation == Operation::LessEqual ||
         operation == Operation::Greater || operation == Operation::GreaterEqual;
}

/// The values of an ordinal that have this order relation to the value at `position`.
std::vector<Expression> values_in_order(std::span<const std::string> values, Operation operation,
                                        std::size_t position) {
  std::vector<Expression> chosen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool below = operation == Operation::Less || operation == Operation::LessEqual;
    const bool equal = operation == Operation::LessEqual || operation == Operation::GreaterEqual;
    const bool beyond = below ? i < position : i > position;
    if (beyond || (equal && i == position)) chosen.push_back(Expression::text(values[i]));
  }
  return chosen;
}

Expected<double> default_value(const ParameterSpace& space, std::size_t index,
                               const std::string& text, const std::string& where) {
  const Domain& domain = space[index].domain;
  if (!space.is_numeric(index)) {
    auto position = position_of(choice_values(domain), text, space[index].name, where);
    if (!position) return Unexpected(position.error());
    return static_cast<double>(*position);
  }
  auto number = number_constant(domain, text, where);
  if (!number) return Unexpected(number.error());
  const double value = round_to_digits(*number->to_number({}), space.digits());
  const Interval* interval = space.constant_interval(index);
  if (value >= interval->lower && value <= interval->upper) return value;
  return bad_input("the default " + exact_text(value) + " of '" + space[index].name +
                       "' is not from " + exact_text(interval->lower) + " to " +
                       exact_text(interval->upper),
                   where);
}

}  // namespace

Expected<void> ForeignBuilder::add(ForeignParameter parameter) {
  if (parameter.name.empty()) return bad_input("a parameter needs a name", parameter.where);
  std::string name = irace_name(parameter.name);
  for (const Known& known : known_) {
    if (known.name != name) continue;
    return bad_input("there is a parameter '" + known.foreign.name + "' above already" +
                         (known.foreign.name == parameter.name
                              ? ""
                              : "; irace has one name for both, '" + name + "': rename one"),
                     parameter.where);
  }
  if (name != parameter.name) {
    if (++renamed_ <= kRenamedTold) {
      warn(parameter.where, "'" + parameter.name + "' is called '" + name +
                                "' here, as irace's names are; the switch keeps the name");
    }
    last_renamed_ = warnings_.size();
  }
  by_name_.emplace(parameter.name, known_.size());
  known_.push_back({std::move(parameter), std::move(name), {}});
  return {};
}

Expected<const ForeignBuilder::Known*> ForeignBuilder::find(const std::string& name,
                                                            const std::string& where) const {
  const auto found = by_name_.find(name);
  if (found != by_name_.end()) return &known_[found->second];
  std::vector<std::string> names;
  for (const auto& [each, position] : by_name_)
    names.push_back(each);
  return bad_input("there is no parameter '" + name + "'" + did_you_mean(name, names), where);
}

Expected<Expression> ForeignBuilder::compare(const std::string& name, Operation operation,
                                             std::span<const std::string> values,
                                             const std::string& where) const {
  const auto known = find(name, where);
  if (!known) return Unexpected(known.error());
  if (values.empty()) return bad_input("expected a value to compare '" + name + "' with", where);
  const Domain& domain = (*known)->foreign.domain;
  const std::span<const std::string> choices = choice_values(domain);
  const Expression parameter = Expression::parameter((*known)->name);
  std::vector<Expression> constants;
  for (const std::string& value : values) {
    auto constant = Expected<Expression>(Expression::text(value));
    if (choices.empty()) {
      constant = number_constant(domain, value, where);
    } else if (auto position = position_of(choices, value, name, where); !position) {
      return Unexpected(position.error());
    }
    if (!constant) return constant;
    constants.push_back(std::move(*constant));
  }
  if (!choices.empty() && is_order(operation)) {
    if (std::holds_alternative<Categorical>(domain)) {
      return bad_input("the values of '" + name +
                           "' have no order: write == or in, or make it "
                           "an ordinal parameter",
                       where);
    }
    constants = values_in_order(choices, operation, *position_of(choices, values[0], name, where));
    if (constants.empty()) return Expression::logical(false);
    operation = Operation::In;
  }
  if (operation == Operation::In) return Expression::in(parameter, std::move(constants));
  return Expression::call(operation, {parameter, std::move(constants.front())});
}

Expected<Expression> ForeignBuilder::relate(const std::string& left, Operation operation,
                                            const std::string& right,
                                            const std::string& where) const {
  std::vector<Expression> operands;
  for (const std::string& name : {left, right}) {
    const auto known = find(name, where);
    if (!known) return Unexpected(known.error());
    if (!choice_values((*known)->foreign.domain).empty()) {
      return bad_input("'" + name +
                           "' is not numeric; only numeric parameters can be compared "
                           "with each other here: write the pairs of values one by one",
                       where);
    }
    operands.push_back(Expression::parameter((*known)->name));
  }
  return Expression::call(operation, std::move(operands));
}

Expected<void> ForeignBuilder::restrict(const std::string& name, Expression condition,
                                        const std::string& where) {
  const auto known = find(name, where);
  if (!known) return Unexpected(known.error());
  std::optional<Expression>& all = known_[by_name_.at(name)].condition;
  all = all ? Expression::call(Operation::And, {std::move(*all), std::move(condition)})
            : std::move(condition);
  return {};
}

/// The decimals that bounds and defaults of reals need; two more for logarithmic ones, so that
/// values near the lower bound differ.
int ForeignBuilder::digits() const {
  int digits = 4;
  for (const Known& known : known_) {
    const auto* real = std::get_if<Real>(&known.foreign.domain);
    if (real == nullptr) continue;
    const Parameter one{known.name, "", *real, {}};
    const int needed = digits_needed({&one, 1}, 1);
    digits = std::max(digits, real->log ? needed + 2 : needed);
    const std::optional<double> initial = number_of(known.foreign.initial.value_or(""));
    while (initial && digits < kMostDigits && !fits_digits(*initial, digits))
      ++digits;
  }
  return std::min(digits, kMostDigits);
}

Expected<std::optional<Configuration>> ForeignBuilder::defaults(const ParameterSpace& space) {
  Assignment values(space);
  for (const std::size_t i : space.hierarchy_order()) {
    const ForeignParameter& foreign = known_[i].foreign;
    if (!foreign.initial) {
      warn(foreign.where, "'" + foreign.name +
                              "' has no default, so the defaults are not the first configuration");
      return std::nullopt;
    }
    const auto value = default_value(space, i, *foreign.initial, foreign.where);
    if (!value) return Unexpected(value.error());
    if (space.is_active(i, values)) values.set(i, *value);
  }
  return values.configuration();
}

Error ForeignBuilder::placed(Error error) const {
  for (const Known& known : known_) {
    if (known.name != error.where) continue;
    return {error.kind, "parameter '" + known.foreign.name + "': " + error.message,
            known.foreign.where};
  }
  return {error.kind, std::move(error.message), file_};
}

Expected<ForeignSpace> ForeignBuilder::build(const ForeignSpaceOptions& options) && {
  if (known_.empty()) return bad_input("the file has no parameter", file_);
  std::vector<Parameter> parameters;
  for (const Known& known : known_) {
    const std::string& text = known.foreign.switch_text;
    parameters.push_back({known.name, text, known.foreign.domain, known.condition});
  }
  auto space = ParameterSpace::make(std::move(parameters), std::move(forbidden_),
                                    options.digits.value_or(digits()));
  if (!space) return Unexpected(placed(std::move(space.error())));
  // Later steps read this text in irace's format, so it is read here as a check.
  auto text = print_parameter_file(*space);
  if (!text) return Unexpected(placed(std::move(text.error())));
  if (auto again = parse_parameter_file({.parameters = {*text, "the converted file"}}); !again) {
    return Unexpected(again.error());
  }
  if (const int more = renamed_ - kRenamedTold; more > 0) {
    warnings_.insert(warnings_.begin() + static_cast<std::ptrdiff_t>(last_renamed_),
                     file_ + ": " + std::to_string(more) +
                         (more == 1 ? " more name is" : " more names are") +
                         " changed like this; --check prints them all");
  }
  auto initial = defaults(*space);
  if (!initial) return Unexpected(initial.error());
  return ForeignSpace{std::move(*space), std::move(*text), std::move(*initial),
                      std::move(warnings_)};
}

}  // namespace swarmsmith::irace
