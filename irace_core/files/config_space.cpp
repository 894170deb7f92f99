#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "irace_core/files/foreign_space.h"
#include "irace_core/files/internal/foreign_builder.h"
#include "irace_core/files/number_text.h"
#include "irace_core/internal/check_parameter.h"

namespace swarmsmith {
namespace {

using irace::ForeignBuilder;
using irace::ForeignParameter;
using Json = nlohmann::json;

constexpr int kDeepest = 100;

/// A value as the target gets it, written as in Python.
Expected<std::string> text_of(const Json& value, const std::string& where) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return std::string(value.get<bool>() ? "True" : "False");
  if (value.is_null()) return std::string("None");
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return shortest_text(value.get<double>());
  return bad_input("expected a text, a number, true, false or null, found " + value.dump(), where);
}

Expected<std::string> text_at(const Json& object, const char* key, const std::string& where) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) {
    return bad_input("expected a member \"" + std::string(key) + "\"", where);
  }
  return text_of(*found, where + "." + key);
}

Expected<std::vector<std::string>> texts_at(const Json& object, const char* key,
                                            const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) {
    return bad_input("expected a list \"" + std::string(key) + "\"", where);
  }
  std::vector<std::string> texts;
  for (const Json& item : *found) {
    auto text = text_of(item, where + "." + key);
    if (!text) return Unexpected(text.error());
    texts.push_back(std::move(*text));
  }
  return texts;
}

Expected<double> number_at(const Json& object, const char* key, const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) {
    return bad_input("expected a number \"" + std::string(key) + "\"", where);
  }
  return found->get<double>();
}

Expected<Domain> numeric_domain(const Json& object, bool whole, const std::string& where) {
  const auto lower = number_at(object, "lower", where);
  const auto upper = number_at(object, "upper", where);
  if (!lower) return Unexpected(lower.error());
  if (!upper) return Unexpected(upper.error());
  const auto step = object.find("q");
  if (step != object.end() && !step->is_null()) {
    return bad_input(
        "irace has no steps (\"q\"): leave \"q\" out, or list the values "
        "of an ordinal parameter",
        where);
  }
  const auto found = object.find("log");
  const bool log = found != object.end() && found->is_boolean() && found->get<bool>();
  if (whole) return Integer{*lower, *upper, log};
  return Real{*lower, *upper, log};
}

template <class Choice>
Expected<Domain> choice_domain(const Json& object, const char* key, const std::string& where) {
  auto values = texts_at(object, key, where);
  if (!values) return Unexpected(values.error());
  return Choice{std::move(*values)};
}

Expected<Domain> domain_of(const Json& object, const std::string& type, const std::string& where) {
  if (type == "uniform_float") return numeric_domain(object, false, where);
  if (type == "uniform_int") return numeric_domain(object, true, where);
  if (type == "categorical") return choice_domain<Categorical>(object, "choices", where);
  if (type == "ordinal") return choice_domain<Ordinal>(object, "sequence", where);
  if (type == "constant" || type == "unparametrized") {
    auto value = text_at(object, "value", where);
    if (!value) return Unexpected(value.error());
    return Categorical{{std::move(*value)}};
  }
  return bad_input("the type \"" + type +
                       "\" does not exist in irace: write uniform_float, uniform_int, categorical, "
                       "ordinal or constant",
                   where);
}

bool has_weights(const Json& object) {
  for (const char* key : {"weights", "probabilities"}) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) continue;
    for (const Json& weight : *found) {
      if (weight != found->front()) return true;
    }
  }
  return false;
}

class ConfigSpaceReader {
 public:
  ConfigSpaceReader(std::string file, const ForeignSpaceOptions& options)
      : file_(std::move(file)), options_(options), builder_(file_) {}

  Expected<ForeignSpace> read(const Json& space);

 private:
  Expected<void> read_parameter(const Json& object, const std::string& where);
  Expected<Expression> read_test(const Json& object, const char* name_key, int depth,
                                 const std::string& where) const;
  Expected<Expression> read_all(const Json& object, const char* name_key, Operation operation,
                                int depth, const std::string& where) const;
  Expected<Expression> read_relation(const Json& object, const std::string& where) const;
  /// Calls `read` for each item of a list; the list may be missing.
  template <class Read>
  Expected<void> each(const Json& space, const char* key, Read read) const;

  std::string file_;
  const ForeignSpaceOptions& options_;
  ForeignBuilder builder_;
};

Expected<void> ConfigSpaceReader::read_parameter(const Json& object, const std::string& where) {
  const auto name = text_at(object, "name", where);
  if (!name) return Unexpected(name.error());
  const auto type = text_at(object, "type", where);
  if (!type) return Unexpected(type.error());
  auto domain = domain_of(object, *type, where);
  if (!domain) return Unexpected(domain.error());
  if (has_weights(object)) {
    builder_.warn(where,
                  "the weights of '" + *name + "' are left out: irace starts with equal weights");
  }
  ForeignParameter parameter{
      *name, options_.aclib ? *name : "--" + *name + " ", std::move(*domain), {}, where};
  for (const char* key : {"default", "default_value", "value"}) {
    const auto found = object.find(key);
    const auto choices = irace::choice_values(parameter.domain);
    const bool has_none = std::ranges::find(choices, "None") != choices.end();
    if (found == object.end() || (found->is_null() && !has_none)) continue;
    auto text = text_of(*found, where + "." + key);
    if (!text) return Unexpected(text.error());
    parameter.initial = std::move(*text);
    break;
  }
  return builder_.add(std::move(parameter));
}

Expected<Expression> ConfigSpaceReader::read_all(const Json& object, const char* name_key,
                                                 Operation operation, int depth,
                                                 const std::string& where) const {
  const auto parts = object.find(object.contains("clauses") ? "clauses" : "conditions");
  if (parts == object.end() || !parts->is_array() || parts->empty() || depth >= kDeepest) {
    return bad_input(
        "expected a list of \"conditions\" or \"clauses\" that is not empty, and no "
        "deeper than " +
            std::to_string(kDeepest),
        where);
  }
  std::optional<Expression> all;
  for (const Json& part : *parts) {
    auto one = read_test(part, name_key, depth + 1, where);
    if (!one) return one;
    all = all ? Expression::call(operation, {std::move(*all), std::move(*one)}) : std::move(*one);
  }
  return *std::move(all);
}

Expected<Expression> ConfigSpaceReader::read_relation(const Json& object,
                                                      const std::string& where) const {
  const auto left = text_at(object, "left", where);
  if (!left) return Unexpected(left.error());
  const auto right = text_at(object, "right", where);
  if (!right) return Unexpected(right.error());
  const auto word = text_at(object, "lambda", where);
  if (!word) return Unexpected(word.error());
  if (*word == "LESS") return builder_.relate(*left, Operation::Less, *right, where);
  if (*word == "GREATER") return builder_.relate(*left, Operation::Greater, *right, where);
  if (*word == "EQUALS") return builder_.relate(*left, Operation::Equal, *right, where);
  return bad_input("expected \"lambda\" to be LESS, GREATER or EQUALS, found \"" + *word + "\"",
                   where);
}

/// Reads a condition, where the parameter is under "parent", or a forbidden clause, where it is
/// under "name".
Expected<Expression> ConfigSpaceReader::read_test(const Json& object, const char* name_key,
                                                  int depth, const std::string& where) const {
  constexpr std::array<std::pair<std::string_view, Operation>, 5> kTests = {{
      {"EQ", Operation::Equal},
      {"EQUALS", Operation::Equal},
      {"NEQ", Operation::NotEqual},
      {"LT", Operation::Less},
      {"GT", Operation::Greater},
  }};
  const auto type = text_at(object, "type", where);
  if (!type) return Unexpected(type.error());
  if (*type == "AND") return read_all(object, name_key, Operation::And, depth, where);
  if (*type == "OR") return read_all(object, name_key, Operation::Or, depth, where);
  if (*type == "RELATION") return read_relation(object, where);
  const auto name = text_at(object, name_key, where);
  if (!name) return Unexpected(name.error());
  if (*type == "IN") {
    const auto values = texts_at(object, "values", where);
    if (!values) return Unexpected(values.error());
    return builder_.compare(*name, Operation::In, *values, where);
  }
  for (const auto& [word, operation] : kTests) {
    if (*type != word) continue;
    const auto value = text_at(object, "value", where);
    if (!value) return Unexpected(value.error());
    return builder_.compare(*name, operation, {&*value, 1}, where);
  }
  return bad_input(
      "expected a \"type\" among EQ, NEQ, IN, LT, GT, AND and OR (forbidden: EQUALS, "
      "IN, AND, RELATION), found \"" +
          *type + "\"",
      where);
}

template <class Read>
Expected<void> ConfigSpaceReader::each(const Json& space, const char* key, Read read) const {
  const auto list = space.find(key);
  if (list == space.end()) return {};
  if (!list->is_array()) return bad_input("expected a list", file_ + ": " + key);
  std::size_t number = 0;
  for (const Json& item : *list) {
    const std::string where = file_ + ": " + key + "[" + std::to_string(number++) + "]";
    if (!item.is_object()) return bad_input("expected an object in { }", where);
    if (Expected<void> done = read(item, where); !done) return done;
  }
  return {};
}

Expected<ForeignSpace> ConfigSpaceReader::read(const Json& space) {
  if (!space.is_object() || !space.contains("hyperparameters")) {
    return bad_input(
        "expected ConfigSpace's JSON, an object with \"hyperparameters\"; parameters "
        "of irace stand in a text file (`swarmsmith irace --init` writes one)",
        file_);
  }
  auto read = each(space, "hyperparameters", [this](const Json& item, const std::string& where) {
    return read_parameter(item, where);
  });
  if (!read) return Unexpected(read.error());
  read = each(space, "conditions", [this](const Json& item, const std::string& where) {
    const auto child = text_at(item, "child", where);
    if (!child) return Expected<void>(Unexpected(child.error()));
    auto condition = read_test(item, "parent", 0, where);
    if (!condition) return Expected<void>(Unexpected(condition.error()));
    return builder_.restrict(*child, std::move(*condition), where);
  });
  if (!read) return Unexpected(read.error());
  read = each(space, "forbiddens", [this](const Json& item, const std::string& where) {
    auto clause = read_test(item, "name", 0, where);
    if (!clause) return Expected<void>(Unexpected(clause.error()));
    builder_.forbid(std::move(*clause));
    return Expected<void>();
  });
  if (!read) return Unexpected(read.error());
  return std::move(builder_).build(options_);
}

}  // namespace

Expected<ForeignSpace> parse_config_space(const IraceText& source,
                                          const ForeignSpaceOptions& options) {
  try {
    return ConfigSpaceReader(source.file, options).read(Json::parse(source.text));
  } catch (const Json::exception& error) {
    return bad_input(std::string("this is not JSON: ") + error.what(), source.file);
  }
}

}  // namespace swarmsmith
