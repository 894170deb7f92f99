#include "coordinator/campaign/internal/sections.h"

#include <algorithm>
#include <iterator>

#include "coordinator/campaign/internal/race_options.h"
#include "sim/control/flavour.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

/// A TOML array of texts.
std::string array_of(const std::vector<std::string>& texts) {
  return "[" + list_of(texts, [](const std::string& text) { return quoted_text(text); }) + "]";
}

void append(std::vector<Section>& sections, std::vector<Section> more) {
  std::ranges::move(more, std::back_inserter(sections));
}

/// A method with the modules that it uses, by name.
void add_method(const Method& method, std::vector<Section>& sections) {
  const std::string prefix = "method." + method.name + ".";
  sections.push_back({"[[method]]",
                      prefix,
                      {{"name", quoted_text(method.name)},
                       {"flavour", quoted_text(method.flavour)},
                       {"turn_clock", quoted_text(name_of(method.turn_clock))},
                       {"max_states", std::to_string(method.max_states)},
                       {"max_transitions", std::to_string(method.max_transitions)},
                       {"behaviours", array_of(method.behaviours)},
                       {"conditions", array_of(method.conditions)}}});
  if (method.ranges.empty()) return;
  Section parameters{"[method.parameters]", prefix + "parameters.", {}};
  const auto flavour = find_flavour(method.flavour);
  for (const RangeOverride& range : method.ranges) {
    std::string type = "real";
    const auto module = module_from_id(range.module);
    for (const ParameterSpec& parameter : (*flavour)->find(*module)->parameters) {
      if (parameter.name != range.parameter) continue;
      if (parameter.type == ParameterSpec::Type::Integer) type = "int";
    }
    parameters.lines.push_back(
        {range.module + "." + range.parameter, "{ " + type + " = [" + number_text(range.lower) +
                                                   ", " + number_text(range.upper) + "] }"});
  }
  sections.push_back(std::move(parameters));
}

/// [race] with every option, also those that have their defaults.
Section race_section(const Campaign& campaign) {
  const Scenario& race = campaign.race;
  Section section{"[race]", "race.", {}};
  for (const IntegerOption& option : kIntegerOptions) {
    section.lines.push_back({std::string(option.key), std::to_string(race.*option.member)});
  }
  if (race.min_experiments) {
    section.lines.push_back({"min_experiments", std::to_string(*race.min_experiments)});
  }
  section.lines.push_back({"test_type", "\"F-test\""});
  for (const RealOption& option : kRealOptions) {
    section.lines.push_back({std::string(option.key), number_text(race.*option.member)});
  }
  for (const FlagOption& option : kFlagOptions) {
    section.lines.push_back({std::string(option.key), flag_text(race.*option.member)});
  }
  section.lines.push_back({"digits", std::to_string(campaign.digits)});
  return section;
}

}  // namespace

std::vector<Section> sections_of(const Campaign& campaign) {
  std::vector<Section> sections;
  sections.push_back({"", "", {{"format", "1", false}}});
  sections.push_back({"[campaign]",
                      "campaign.",
                      {{"name", quoted_text(campaign.name), false},
                       {"seed", std::to_string(campaign.seed)},
                       {"repetitions", std::to_string(campaign.repetitions)}}});
  for (const CampaignMission& mission : campaign.missions)
    append(sections, mission_sections(mission));
  for (const Method& method : campaign.methods)
    add_method(method, sections);
  sections.push_back(race_section(campaign));
  sections.push_back({"[simulator]", "simulator.", {{"kind", "\"builtin\""}}});
  append(sections, profile_sections(campaign.profile, "simulator.profile"));
  return sections;
}

}  // namespace swarmsmith
