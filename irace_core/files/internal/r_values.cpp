#include "irace_core/files/internal/r_values.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/overloaded.h"
#include "base/plain_text.h"
#include "base/suggestion.h"
#include "irace_core/files/internal/r_functions.h"
#include "irace_core/files/internal/r_operators.h"
#include "irace_core/files/internal/r_texts.h"

namespace swarmsmith::r {
namespace {

Expression expression_of(const Vector& vector) {
  if (vector.size() == 1) return Expression::constant(vector.front());
  std::vector<Expression> elements;
  for (const Scalar& element : vector)
    elements.push_back(Expression::constant(element));
  return Expression::call(Operation::Combine, std::move(elements));
}

/// Applies an operator or function that conditions also have.
Expected<Vector> apply(const Node& node, const std::string& function, Operation operation,
                       const std::vector<Part>& parts) {
  const Arity wanted = arity(operation);
  if (parts.size() < wanted.least || parts.size() > wanted.most) {
    return wrong(node, "`" + function + "` does not take " + counted(parts.size(), "value"));
  }
  std::vector<Expression> operands;
  for (const Part& part : parts) {
    if (!part.name.empty()) {
      return wrong(node, "the values of `" + function + "` must not be named here");
    }
    if (part.value.empty()) return wrong(node, "`" + function + "` cannot be applied to NULL");
    operands.push_back(expression_of(part.value));
  }
  const Values values = Expression::call(operation, std::move(operands)).evaluate({});
  Vector result;
  for (std::size_t i = 0; i < values.size(); ++i)
    result.push_back(values[i]);
  return result;
}

/// c and list: all elements in one vector; c converts them to one type.
Expected<Vector> combine(const Node& node, const std::vector<Part>& parts, bool one_type) {
  Vector all;
  std::size_t length = 0;
  for (const Part& part : parts) {
    for (const Scalar& element : part.value) {
      length += element.text.size();
      if (length > kLongestText || all.size() == kLongestVector) {
        return wrong(node, "makes too long a vector");
      }
      all.push_back(element);
    }
  }
  if (!one_type || all.size() < 2) return all;
  return apply(node, "c", Operation::Combine, {Part{{}, std::move(all)}});
}

/// The operation of an operator or function of conditions; nothing for any other name.
std::optional<Operation> operation_of(const std::string& name, std::size_t operands) {
  if (name == "-" && operands == 1) return Operation::Negate;
  if (name == "!") return Operation::Not;
  if (const irace::Spelling* spelling = irace::find_operator(name)) return spelling->operation;
  if (const irace::Spelling* spelling = irace::find_function(name)) return spelling->operation;
  return std::nullopt;
}

/// Functions that do not exist in conditions.
constexpr std::array<std::string_view, 5> kOthers = {"paste", "paste0", "file.path", "list",
                                                     "Sys.getenv"};

class Evaluator {
 public:
  explicit Evaluator(const Environment& environment) : environment_(environment) {}

  Expected<Vector> value(const Node& node) const {
    return std::visit(
        Overloaded{
            [](const Number& number) -> Expected<Vector> {
              return Vector{number.is_integer ? Scalar::integer(number.value)
                                              : Scalar::real(number.value)};
            },
            [](const Text& text) -> Expected<Vector> {
              return Vector{Scalar::of_text(text.value)};
            },
            [](const Logical& logical) -> Expected<Vector> {
              return Vector{logical.value ? Scalar::logical(*logical.value) : Scalar{}};
            },
            [](const Null&) -> Expected<Vector> { return Vector{}; },
            [&](const Name& name) { return variable(node, name.value); },
            [&](const Call& call) { return this->call(node, call); },
        },
        node.what);
  }

 private:
  Expected<Vector> variable(const Node& node, const std::string& name) const {
    const auto found = environment_.variables.find(name);
    if (found != environment_.variables.end()) return found->second;
    if (const auto logical = logical_of(node)) return Vector{Scalar::logical(*logical)};
    std::vector<std::string> known;
    for (const auto& entry : environment_.variables)
      known.push_back(entry.first);
    return wrong(node, "nothing was assigned to `" + name + "` before" + did_you_mean(name, known) +
                           "; texts need quotes");
  }

  Expected<Vector> call(const Node& node, const Call& call) const {
    // Checked before the arguments, so that in library(x) the error is about library, not x.
    const std::string& name = call.function;
    const auto operation = operation_of(name, call.arguments.size());
    const bool is_ours = is_scenario_function(name);
    if (!operation && !is_ours && std::ranges::find(kOthers, name) == kOthers.end()) {
      return wrong(node, "found the function `" + name +
                             "`: programs in R are not read here, only values, made with " +
                             "list paste paste0 file.path Sys.getenv " +
                             std::string(scenario_function_names()) + " " +
                             std::string(irace::function_names()));
    }
    std::vector<Part> parts;
    for (const Argument& argument : call.arguments) {
      auto part = value(argument.value);
      if (!part) return part;
      parts.push_back({argument.name, std::move(*part)});
    }
    if (name == "paste") return paste(node, std::move(parts), "sep", " ");
    if (name == "paste0") return paste(node, std::move(parts), "", "");
    if (name == "file.path") return paste(node, std::move(parts), "fsep", "/");
    if (name == "c" || name == "list") return combine(node, parts, name == "c");
    if (name == "Sys.getenv") return environment_variable(node, std::move(parts), environment_);
    if (is_ours) return call_scenario_function(node, name, std::move(parts), environment_);
    if (name == "+" && parts.size() == 1) return parts.front().value;
    return apply(node, name, *operation, parts);
  }

  const Environment& environment_;
};

}  // namespace

std::vector<std::string> to_texts(const Vector& vector) {
  std::vector<std::string> texts;
  for (const Scalar& element : vector)
    texts.push_back(to_text(element));
  return texts;
}

Expected<Vector> evaluate(const Node& node, const Environment& environment) {
  auto vector = Evaluator(environment).value(node);
  if (vector && vector->size() > kLongestVector) return wrong(node, "makes too long a vector");
  return vector;
}

}  // namespace swarmsmith::r
