#pragma once

#include <string>
#include <utility>
#include <vector>

#include "irace_core/parameter_space.h"

namespace swarmsmith::testing {

/// Shorthand for building trees in tests.
inline Expression name(std::string parameter) {
  return Expression::parameter(std::move(parameter));
}
inline Expression number(double value) {
  return Expression::number(value);
}
inline Expression text(std::string value) {
  return Expression::text(std::move(value));
}
inline Expression call(Operation operation, Expression a) {
  return Expression::call(operation, {std::move(a)});
}
inline Expression call(Operation operation, Expression a, Expression b) {
  return Expression::call(operation, {std::move(a), std::move(b)});
}
inline Expression negate_of(double value) {
  return call(Operation::Negate, number(value));
}
inline Expression call(Operation operation, Expression a, Expression b, Expression c) {
  return Expression::call(operation, {std::move(a), std::move(b), std::move(c)});
}
inline Expression equals(std::string parameter, std::string value) {
  return call(Operation::Equal, name(std::move(parameter)), text(std::move(value)));
}

inline Parameter make_real(std::string id, double lower, double upper, bool log = false) {
  return {std::move(id), "", Real{lower, upper, log}, {}};
}
inline Parameter make_integer(std::string id, double lower, double upper, bool log = false) {
  return {std::move(id), "", Integer{lower, upper, log}, {}};
}
inline Parameter make_categorical(std::string id, std::vector<std::string> values) {
  return {std::move(id), "", Categorical{std::move(values)}, {}};
}
inline Parameter make_ordinal(std::string id, std::vector<std::string> values) {
  return {std::move(id), "", Ordinal{std::move(values)}, {}};
}
inline Parameter active_when(Parameter parameter, Expression condition) {
  parameter.condition = std::move(condition);
  return parameter;
}

/// A valid space of these parameters.
inline ParameterSpace space_of(std::vector<Parameter> parameters,
                               std::vector<Expression> forbidden = {}, int digits = 4) {
  return ParameterSpace::make(std::move(parameters), std::move(forbidden), digits).value();
}

/// The 149 parameters of AutoMoDe-Watermelon: machines of up to four states with up to four
/// transitions each; targets depend on the number of states.
ParameterSpace automode_space();

}  // namespace swarmsmith::testing
