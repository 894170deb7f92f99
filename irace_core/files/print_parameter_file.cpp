#include <algorithm>

#include "base/overloaded.h"
#include "irace_core/files/expression_text.h"
#include "irace_core/files/internal/parameter_line.h"
#include "irace_core/files/parameter_file.h"

namespace swarmsmith {
namespace {

Unexpected cannot_hold(const std::string& what, const std::string& text, const std::string& name) {
  return bad_input("irace's parameter files cannot hold the " + what + " '" + text + "'", name);
}

bool is_plain(const std::string& value) {
  return !value.empty() && std::all_of(value.begin(), value.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-' || c == '+';
  });
}

/// A value that contains quotes can only be written without quotes around it, where commas and some
/// other characters have a meaning.
bool fits_without_quotes(const std::string& value) {
  return !value.empty() && value.front() != '"' && irace::trimmed(value).size() == value.size() &&
         value.find_first_of(",|#()") == std::string::npos;
}

Expected<std::string> print_value(const std::string& value, const std::string& name) {
  if (value.find_first_of("\n\r") != std::string::npos) return cannot_hold("value", value, name);
  if (is_plain(value)) return value;
  if (value.find('"') == std::string::npos) return "\"" + value + "\"";
  if (!fits_without_quotes(value)) return cannot_hold("value", value, name);
  return value;
}

std::string print_bound(const Bound& bound) {
  return std::visit(Overloaded{
                        [](double value) { return print(Expression::number(value)); },
                        [](const Expression& expression) {
                          const std::string text = print(expression);
                          return is_plain(text) ? text : "\"" + text + "\"";
                        },
                    },
                    bound);
}

Expected<std::string> print_choices(const std::vector<std::string>& values,
                                    const std::string& name) {
  std::string text;
  for (const std::string& value : values) {
    auto printed = print_value(value, name);
    if (!printed) return printed;
    if (!text.empty()) text += ", ";
    text += *printed;
  }
  return text;
}

Expected<std::string> print_parameter(const Parameter& parameter) {
  const std::string& name = parameter.name;
  if (parameter.switch_text.find_first_of("\"\n\r") != std::string::npos) {
    return cannot_hold("switch", parameter.switch_text, name);
  }
  std::string type;
  auto domain = Expected<std::string>("");
  const auto numeric = [](const auto& one) {
    return print_bound(one.lower) + ", " + print_bound(one.upper);
  };
  std::visit(Overloaded{
                 [&](const Categorical& one) {
                   type = "c";
                   domain = print_choices(one.values, name);
                 },
                 [&](const Ordinal& one) {
                   type = "o";
                   domain = print_choices(one.values, name);
                 },
                 [&](const Integer& one) {
                   type = one.log ? "i,log" : "i";
                   domain = numeric(one);
                 },
                 [&](const Real& one) {
                   type = one.log ? "r,log" : "r";
                   domain = numeric(one);
                 },
             },
             parameter.domain);
  if (!domain) return domain;
  std::string line = name + " \"" + parameter.switch_text + "\" " + type + " (" + *domain + ")";
  if (parameter.condition) line += " | " + print(*parameter.condition);
  return line + "\n";
}

}  // namespace

Expected<Irace35Files> print_irace_35_files(const ParameterSpace& space) {
  Irace35Files files;
  for (const Parameter& parameter : space.parameters()) {
    auto line = print_parameter(parameter);
    if (!line) return Unexpected(line.error());
    files.parameters += *line;
  }
  for (const Expression& clause : space.forbidden())
    files.forbidden += print(clause) + "\n";
  files.digits = space.digits();
  return files;
}

Expected<std::string> print_parameter_file(const ParameterSpace& space) {
  auto files = print_irace_35_files(space);
  if (!files) return Unexpected(files.error());
  std::string text = std::move(files->parameters);
  if (!files->forbidden.empty()) text += "\n[forbidden]\n" + files->forbidden;
  return text + "\n[global]\ndigits = " + std::to_string(files->digits) + "\n";
}

}  // namespace swarmsmith
