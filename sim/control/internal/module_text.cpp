#include "sim/control/internal/module_text.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>

#include "base/plain_text.h"

namespace swarmsmith {
namespace {

Expected<double> read_label(const Field& field, int number, const Flavour& flavour) {
  std::string known;
  for (const LabelSpec& spec : flavour.floor.labels) {
    if (spec.number == number) return static_cast<double>(spec.label);
    known += (known.empty() ? "" : ", ") + std::to_string(spec.number) + " " +
             std::string(name_of(spec.label));
  }
  return Unexpected(error_at(field.value, quoted(field.name.text) + " has no label " +
                                              std::to_string(number) + "; labels are " + known));
}

Expected<double> read_value(const ParameterSpec& parameter, const Field& field,
                            const Flavour& flavour) {
  double value = 0;
  if (parameter.type == ParameterSpec::Type::Real) {
    if (!read_number(field.value.text, value)) {
      return Unexpected(error_at(field.value, quoted(field.name.text) + " must be a number, not " +
                                                  quoted(field.value.text)));
    }
  } else {
    const Expected<int> number = integer_of(field);
    if (!number) return Unexpected(number.error());
    if (parameter.type == ParameterSpec::Type::Label) return read_label(field, *number, flavour);
    value = *number;
  }
  if (const auto complaint = complaint_about(parameter, value)) {
    return Unexpected(error_at(field.value, quoted(field.name.text) + ": " + *complaint + ", not " +
                                                std::string(field.value.text)));
  }
  return value;
}

}  // namespace

Expected<const ModuleSpec*> read_module(const Field& field, const std::vector<ModuleSpec>& table,
                                        const Flavour& flavour) {
  const Expected<int> number = integer_of(field);
  if (!number) return Unexpected(number.error());
  std::string known;
  for (const ModuleSpec& spec : table) {
    if (spec.number == *number) return &spec;
    known += (known.empty() ? "" : ", ") + std::to_string(spec.number) + " " + spec.id;
  }
  return Unexpected(error_at(field.value, "the flavour " + flavour.name + " has no module " +
                                              std::to_string(*number) + " for " +
                                              quoted(field.name.text) + "; it has " + known));
}

Expected<std::vector<double>> read_parameters(const ModuleSpec& spec, Block& block,
                                              const Flavour& flavour) {
  std::vector<double> values;
  for (const ParameterSpec& parameter : spec.parameters) {
    const Expected<Field> field = block.need(parameter.token);
    if (!field) return Unexpected(field.error());
    const Expected<double> value = read_value(parameter, *field, flavour);
    if (!value) return Unexpected(value.error());
    values.push_back(*value);
  }
  return values;
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

void append_switch(std::string& text, std::string_view stem, std::string_view suffix,
                   std::string_view value) {
  if (!text.empty()) text += ' ';
  text.append("--").append(stem).append(suffix).append(" ").append(value);
}

void append_parameters(std::string& text, const ModuleSpec& spec, const std::vector<double>& values,
                       const std::string& suffix, const Flavour& flavour) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    double value = values[i];
    if (spec.parameters[i].type == ParameterSpec::Type::Label) {
      for (const LabelSpec& label : flavour.floor.labels) {
        if (static_cast<double>(label.label) == values[i]) value = label.number;
      }
    }
    // The shortest form of 100,000 is 1e+05, which does not read as an integer.
    const bool is_real = spec.parameters[i].type == ParameterSpec::Type::Real;
    append_switch(text, spec.parameters[i].token, suffix,
                  is_real ? shortest(value) : std::to_string(static_cast<std::int64_t>(value)));
  }
}

std::optional<std::string> complaint_about_module(Module module, const std::vector<double>& values,
                                                  const Flavour& flavour) {
  const ModuleSpec* spec = flavour.find(module);
  if (spec == nullptr) {
    return "the flavour " + flavour.name + " has no module " + std::string(id_of(module));
  }
  if (values.size() != spec->parameters.size()) {
    return spec->id + " takes " + counted(spec->parameters.size(), "parameter") + ", not " +
           std::to_string(values.size());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (auto complaint = complaint_about(spec->parameters[i], values[i])) return complaint;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
