#include "sim/control/flavour_text.h"

#include <cstddef>
#include <string_view>
#include <utility>

#include "sim/control/internal/flavour_fields.h"

namespace swarmsmith {
namespace {

/// The visitor that writes the constants as lines.
class ConstantWriter {
 public:
  ConstantWriter(std::vector<Section>& sections, std::string header)
      : sections_(&sections), prefix_(header.empty() ? "" : header + ".") {
    sections_->push_back({header.empty() ? "" : "[" + header + "]", prefix_, {}});
  }

  void table(std::string_view name) {
    const std::string path = prefix_ + std::string(name);
    sections_->push_back({"[" + path + "]", path + ".", {}});
  }
  void number(std::string_view key, double value, FlavourLimits) { add(key, number_text(value)); }
  void integer(std::string_view key, int value, FlavourLimits) { add(key, std::to_string(value)); }
  void flag(std::string_view key, bool value) { add(key, flag_text(value)); }
  template <class Value, std::size_t Count>
  void choice(std::string_view key, Value value, const FlavourChoices<Value, Count>& choices) {
    for (const auto& [word, meaning] : choices) {
      if (meaning == value) add(key, quoted_text(word));
    }
  }
  void grays(std::string_view key, const GrayRange& range) {
    add(key, "[" + number_text(range.low / kGrayThousandths) + ", " +
                 number_text(range.high / kGrayThousandths) + "]");
  }
  void labels(std::string_view key, const std::vector<LabelSpec>& labels) {
    add(key, "[" + list_of(labels, [](const LabelSpec& label) {
               return "{ name = " + quoted_text(name_of(label.label)) +
                      ", number = " + std::to_string(label.number) +
                      ", hue_deg = " + number_text(label.hue_deg) +
                      ", saturation = " + number_text(label.saturation) + " }";
             }) + "]");
  }
  void add(std::string_view key, std::string value) {
    sections_->back().lines.push_back({std::string(key), std::move(value)});
  }

 private:
  std::vector<Section>* sections_;
  std::string prefix_;
};

std::string range_text(const ParameterSpec& parameter) {
  return "[" + number_text(parameter.low) + ", " + number_text(parameter.high) + "]";
}

/// The text of a parameter: only its range if the rest is the default of its kind.
std::string parameter_text(const ParameterSpec& parameter, ParameterSpec kind) {
  kind.low = parameter.low;
  kind.high = parameter.high;
  if (parameter == kind) return range_text(parameter);
  std::string text = "{ range = " + range_text(parameter) +
                     ", token = " + quoted_text(parameter.token) +
                     ", symbol = " + quoted_text(parameter.symbol);
  if (parameter.type == ParameterSpec::Type::Real)
    text += ", digits = " + std::to_string(parameter.digits);
  return text + " }";
}

std::string external_parameter_text(const ParameterSpec& parameter) {
  const bool is_real = parameter.type == ParameterSpec::Type::Real;
  return "{ name = " + quoted_text(parameter.name) + ", token = " + quoted_text(parameter.token) +
         ", symbol = " + quoted_text(parameter.symbol) +
         ", type = " + (is_real ? "\"real\"" : "\"int\"") + ", range = " + range_text(parameter) +
         (is_real ? ", digits = " + std::to_string(parameter.digits) : "") + " }";
}

std::string module_text(const ModuleSpec& spec) {
  std::string text = "{ number = " + std::to_string(spec.number);
  if (is_external(spec.module)) {
    text += ", kind = \"external\"";
    if (spec.parameters.empty()) return text + " }";
    return text + ", parameters = [" + list_of(spec.parameters, external_parameter_text) + "] }";
  }
  const std::vector<ParameterSpec> kind = parameters_of_kind(spec.module);
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const ParameterSpec& parameter = spec.parameters[i];
    if (parameter.type == ParameterSpec::Type::Label) continue;
    text += ", " + parameter.name + " = " + parameter_text(parameter, kind[i]);
  }
  return text + " }";
}

}  // namespace

std::vector<Section> flavour_sections(const Flavour& flavour, const std::string& header) {
  std::vector<Section> sections;
  ConstantWriter writer(sections, header);
  writer.add("name", quoted_text(flavour.name));
  writer.add("reference", quoted_text(flavour.reference));
  visit_flavour_fields(flavour, writer);
  for (const auto& [key, modules] : {std::pair("behaviours", &flavour.behaviours),
                                     std::pair("conditions", &flavour.conditions)}) {
    writer.table(key);
    for (const ModuleSpec& spec : *modules)
      writer.add(spec.id, module_text(spec));
  }
  return sections;
}

std::string flavour_text(const Flavour& flavour) {
  std::vector<Section> sections = flavour_sections(flavour, "");
  sections.front().lines.front() = {"format", "1"};  // replaces the name, which is the name of the
                                                     // file
  return text_of(sections);
}

}  // namespace swarmsmith
