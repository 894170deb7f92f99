#include "irace_core/files/internal/r_values.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/overloaded.h"
#include "base/suggestion.h"
#include "irace_core/files/internal/r_operators.h"

namespace swarmsmith::r {
namespace {

constexpr std::size_t kLongestVector = 100'000;
constexpr std::size_t kLongestText = 1'000'000;  // of all elements together

/// An argument with its value.
struct Part {
  std::string name;
  Vector value;
};

Unexpected wrong(const Node& node, std::string message) {
  return bad_input(std::move(message), to_string(node.place));
}

/// The value of the named argument, taken out of the list.
std::optional<Vector> take(std::vector<Part>& parts, std::string_view name) {
  const auto part = std::ranges::find(parts, name, &Part::name);
  if (part == parts.end()) return std::nullopt;
  Vector value = std::move(part->value);
  parts.erase(part);
  return value;
}

/// The text that separates: `initial` when the argument is missing, or has no name because it
/// cannot be given; nothing for NULL.
Expected<std::optional<std::string>> take_separator(const Node& node, std::vector<Part>& parts,
                                                    std::string_view name,
                                                    std::optional<std::string> initial) {
  if (name.empty()) return initial;
  const std::optional<Vector> value = take(parts, name);
  if (!value) return initial;
  if (value->empty()) return std::optional<std::string>{};
  if (value->size() != 1 || value->front().missing || value->front().type != Scalar::Type::Text) {
    return wrong(node, "`" + std::string(name) + "` must be a text");
  }
  return std::optional(value->front().text);
}

/// paste: the parts' elements side by side, shorter parts repeated; empty ones count for nothing.
/// With `collapse` all become one.
Expected<Vector> paste(const Node& node, std::vector<Part> parts, std::string_view separator_name,
                       std::optional<std::string> separator) {
  const auto between = take_separator(node, parts, separator_name, std::move(separator));
  if (!between) return Unexpected(between.error());
  const auto collapse = take_separator(node, parts, "collapse", std::nullopt);
  if (!collapse) return Unexpected(collapse.error());
  std::vector<std::vector<std::string>> columns;
  std::size_t rows = 0;
  for (const Part& part : parts) {
    if (!part.name.empty()) return wrong(node, "has no argument `" + part.name + "`");
    if (part.value.empty()) continue;
    columns.push_back(to_texts(part.value));
    rows = std::max(rows, part.value.size());
  }
  std::vector<std::string> lines(rows);
  std::size_t length = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      if (column > 0) lines[row] += between->value_or("");
      lines[row] += columns[column][row % columns[column].size()];
    }
    length += lines[row].size();
    if (length > kLongestText) return wrong(node, "makes too long a text");
  }
  if (*collapse) {
    std::string whole;
    if (length + rows * (*collapse)->size() > kLongestText) {
      return wrong(node, "makes too long a text");
    }
    for (std::size_t row = 0; row < rows; ++row)
      whole += (row > 0 ? **collapse : "") + lines[row];
    return Vector{Scalar::of_text(std::move(whole))};
  }
  Vector result;
  for (std::string& line : lines)
    result.push_back(Scalar::of_text(std::move(line)));
  return result;
}

/// Sys.getenv("NAME", unset = ""), one name.
Expected<Vector> environment_variable(const Node& node, std::vector<Part> parts,
                                      const Environment& environment) {
  const std::optional<Vector> named = take(parts, "unset");
  Vector unset = named.value_or(Vector{Scalar::of_text("")});
  if (const auto name = take(parts, "x")) parts.insert(parts.begin(), Part{{}, *name});
  if (parts.size() == 2 && !named) {
    unset = parts[1].value;
    parts.pop_back();
  }
  const bool is_one_text = parts.size() == 1 && parts[0].name.empty() &&
                           parts[0].value.size() == 1 && !parts[0].value[0].missing &&
                           parts[0].value[0].type == Scalar::Type::Text;
  if (!is_one_text) return wrong(node, "Sys.getenv needs the name of one variable, in quotes");
  if (auto value = environment.environment_variable(parts[0].value[0].text)) {
    return Vector{Scalar::of_text(std::move(*value))};
  }
  return unset;
}

Expression expression_of(const Vector& vector) {
  if (vector.size() == 1) return Expression::constant(vector.front());
  std::vector<Expression> elements;
  for (const Scalar& element : vector)
    elements.push_back(Expression::constant(element));
  return Expression::call(Operation::Combine, std::move(elements));
}

/// Operators and functions that conditions have, too.
Expected<Vector> apply(const Node& node, const std::string& function, Operation operation,
                       const std::vector<Part>& parts) {
  const Arity wanted = arity(operation);
  if (parts.size() < wanted.least || parts.size() > wanted.most) {
    return wrong(node, "`" + function + "` does not take " + std::to_string(parts.size()) +
                           (parts.size() == 1 ? " value" : " values"));
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

/// c and list: all elements; c gives them one type.
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

/// Nothing for what is no operator and no function of conditions.
std::optional<Operation> operation_of(const std::string& name, std::size_t operands) {
  if (name == "-" && operands == 1) return Operation::Negate;
  if (name == "!") return Operation::Not;
  if (const irace::Spelling* spelling = irace::find_operator(name)) return spelling->operation;
  if (const irace::Spelling* spelling = irace::find_function(name)) return spelling->operation;
  return std::nullopt;
}

/// Functions that conditions do not have.
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
    // Before the arguments: library(x) is not to be blamed for x.
    const std::string& name = call.function;
    const auto operation = operation_of(name, call.arguments.size());
    if (!operation && std::ranges::find(kOthers, name) == kOthers.end()) {
      return wrong(node, "found the function `" + name +
                             "`: programs in R are not read here, only values, made with " +
                             "list paste paste0 file.path Sys.getenv " +
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
