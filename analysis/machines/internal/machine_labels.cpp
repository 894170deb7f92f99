#include "analysis/machines/internal/machine_labels.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/plain_text.h"

namespace swarmsmith {
namespace {

std::vector<std::string> name_lines(const ModuleSpec& spec) {
  std::vector<std::string> lines;
  if (is_external(spec.module)) {
    std::string words = spec.id;
    std::ranges::replace(words, '_', ' ');
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return {std::move(words)};
  }
  for (const std::string_view line : split(label_of(spec.module), '\n'))
    lines.emplace_back(line);
  return lines;
}

/// The letter for the parameter in the thesis, or in the papers on random walks.
std::string symbol_of(const std::string& parameter) {
  if (parameter == "tau") return "τ";
  if (parameter == "alpha") return "α";
  if (parameter == "beta") return "β";
  if (parameter == "xi") return "ξ";
  if (parameter == "eta") return "η";
  if (parameter == "rho") return "ρ";
  if (parameter == "mu") return "μ";
  return parameter;
}

/// Values from the search have two decimals. Longer numbers from users are shortened, because a
/// picture is not used to read a machine back.
std::string value_text(double value) {
  std::string text = fmt::format("{}", value);
  return text.size() <= 7 ? text : fmt::format("{:.4g}", value);
}

ModuleLabel label(Module module, std::span<const double> values, const Flavour& flavour) {
  const ModuleSpec* spec = flavour.find(module);
  if (spec == nullptr) {
    throw std::invalid_argument("the flavour " + flavour.name + " has no module " +
                                std::string(id_of(module)));
  }
  std::string parameters;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterSpec& parameter = spec->parameters.at(i);
    if (i > 0) parameters += ", ";
    if (parameter.type == ParameterSpec::Type::Label) {
      parameters += name_of(static_cast<ColorLabel>(static_cast<int>(values[i])));
    } else {
      parameters += symbol_of(parameter.name) + " = " + value_text(values[i]);
    }
  }
  ModuleLabel result{.name = name_lines(*spec), .parameters = {}};
  if (!parameters.empty()) result.parameters.push_back(std::move(parameters));
  return result;
}

/// Breaks each line after each `end` and removes a blank after it.
std::vector<std::string> cut_lines(const std::vector<std::string>& lines, char end) {
  std::vector<std::string> cut;
  for (std::string_view line : lines) {
    while (!line.empty()) {
      const std::size_t at = std::min(line.find(end), line.size());
      const std::size_t next = std::min(at + (end == ' ' ? 0 : 1), line.size());
      cut.emplace_back(line.substr(0, next));
      line.remove_prefix(next);
      if (line.starts_with(' ')) line.remove_prefix(1);
    }
  }
  return cut;
}

}  // namespace

ModuleLabel narrowed(const ModuleLabel& label) {
  return {.name = cut_lines(label.name, ' '), .parameters = cut_lines(label.parameters, ',')};
}

ModuleLabel label_of(const Behaviour& behaviour, const Flavour& flavour) {
  return label(module_of(behaviour), parameters_of(behaviour), flavour);
}

ModuleLabel label_of(const Condition& condition, const Flavour& flavour) {
  return label(module_of(condition), parameters_of(condition), flavour);
}

}  // namespace swarmsmith
