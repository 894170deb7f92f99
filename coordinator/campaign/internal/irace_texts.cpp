#include "coordinator/campaign/internal/irace_texts.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// In double quotes; the spaces of machines have no text that needs more.
std::string quoted(const std::string& text) {
  return "\"" + text + "\"";
}

struct Written {
  Operation operation;
  std::string_view text;
};
constexpr std::array<Written, 4> kBinary = {{{Operation::Greater, ">"},
                                             {Operation::Equal, "=="},
                                             {Operation::Subtract, "-"},
                                             {Operation::In, "%in%"}}};

/// `a > b`, `f(a, b)`: what conditions and bounds of machines are made of.
std::string expression_text(const Expression& expression) {
  std::vector<std::string> operands;
  for (const Expression& operand : expression.operands())
    operands.push_back(expression_text(operand));
  std::string list;
  for (const std::string& operand : operands)
    list += (list.empty() ? "" : ", ") + operand;
  const Operation operation = expression.operation();
  if (operation == Operation::Parameter) return expression.name();
  if (operation == Operation::Constant) {
    const Scalar value = expression.evaluate({})[0];
    return value.type == Scalar::Type::Text ? quoted(value.text) : to_fixed_text(value.number);
  }
  if (operation == Operation::Combine) return "c(" + list + ")";
  if (operation == Operation::Max) return "max(" + list + ")";
  const auto binary = std::ranges::find(kBinary, operation, &Written::operation);
  SWARMSMITH_ASSERT(binary != kBinary.end(), "spaces of machines have no other expressions");
  return operands[0] + " " + std::string(binary->text) + " " + operands[1];
}

/// In quotes where it has commas, at which irace 3.5 would take the domain apart.
std::string bound_text(const Bound& bound) {
  if (const double* number = std::get_if<double>(&bound)) return to_fixed_text(*number);
  const std::string text = expression_text(std::get<Expression>(bound));
  return text.find(',') == std::string::npos ? text : quoted(text);
}

std::string domain_text(const Domain& domain) {
  if (const auto* choice = std::get_if<Categorical>(&domain)) {
    std::string list;
    for (const std::string& value : choice->values)
      list += (list.empty() ? "" : ", ") + value;
    return "c (" + list + ")";
  }
  if (const auto* whole = std::get_if<Integer>(&domain)) {
    return "i (" + bound_text(whole->lower) + ", " + bound_text(whole->upper) + ")";
  }
  const auto& real = std::get<Real>(domain);
  return "r (" + bound_text(real.lower) + ", " + bound_text(real.upper) + ")";
}

}  // namespace

std::string irace_parameters(const ParameterSpace& space, IraceVersion version) {
  std::string text;
  for (const Parameter& parameter : space.parameters()) {
    text +=
        parameter.name + " " + quoted(parameter.switch_text) + " " + domain_text(parameter.domain);
    if (parameter.condition) text += " | " + expression_text(*parameter.condition);
    text += "\n";
  }
  if (version == IraceVersion::V4) {
    text += "[global]\ndigits = " + std::to_string(space.digits()) + "\n";
  }
  return text;
}

std::string irace_scenario(const Scenario& race, int digits, bool with_tests,
                           IraceVersion version) {
  std::string text;
  const auto say = [&](const char* name, const std::string& value) {
    text += std::string(name) + " = " + value + "\n";
  };
  const auto number = [](auto value) { return to_fixed_text(static_cast<double>(value)); };
  say("parameterFile", quoted("./parameters.txt"));
  say("targetRunner", quoted("./target-runner"));
  say("trainInstancesDir", quoted(""));
  say("trainInstancesFile", quoted("./instances.txt"));
  if (with_tests) say("testInstancesFile", quoted("./test-instances.txt"));
  say("maxExperiments", number(race.max_experiments));
  if (version == IraceVersion::V3_5) say("digits", number(digits));
  say("softRestartThreshold", number(race.soft_restart_threshold));

  const Scenario usual;
  const auto say_if_other = [&](const char* name, auto value, auto usually) {
    if (value != usually) say(name, number(value));
  };
  say_if_other("sampleInstances", race.sample_instances, usual.sample_instances);
  say_if_other("deterministic", race.deterministic, usual.deterministic);
  say_if_other("confidence", race.confidence, usual.confidence);
  say_if_other("firstTest", race.first_test, usual.first_test);
  say_if_other("eachTest", race.each_test, usual.each_test);
  say_if_other("blockSize", race.block_size, usual.block_size);
  say_if_other("nbIterations", race.nb_iterations, usual.nb_iterations);
  say_if_other("minNbSurvival", race.min_nb_survival, usual.min_nb_survival);
  say_if_other("nbConfigurations", race.nb_configurations, usual.nb_configurations);
  say_if_other("nbExperimentsPerIteration", race.nb_experiments_per_iteration,
               usual.nb_experiments_per_iteration);
  say_if_other("mu", race.mu, usual.mu);
  say_if_other("elitist", race.elitist, usual.elitist);
  say_if_other("elitistNewInstances", race.elitist_new_instances, usual.elitist_new_instances);
  say_if_other("elitistLimit", race.elitist_limit, usual.elitist_limit);
  say_if_other("softRestart", race.soft_restart, usual.soft_restart);
  switch (test_type_of(race)) {
    case TestType::FTest:
      break;
    case TestType::TTest:
      say("testType", quoted("t-test"));
      break;
    case TestType::TTestBonferroni:
      say("testType", quoted("t-test-bonferroni"));
      break;
    case TestType::TTestHolm:
      say("testType", quoted("t-test-holm"));
      break;
  }
  // In irace 3.5 this is the part of the budget that is kept for it, none by default.
  if (version == IraceVersion::V4) {
    say_if_other("postselection", race.postselection, usual.postselection);
  }
  return text;
}

}  // namespace swarmsmith
