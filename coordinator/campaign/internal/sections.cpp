#include "coordinator/campaign/internal/sections.h"

#include <algorithm>
#include <iterator>

#include "coordinator/campaign/internal/method_search.h"
#include "coordinator/campaign/internal/race_options.h"
#include "coordinator/campaign/internal/target_sections.h"
#include "sim/control/flavour.h"
#include "sim/control/flavour_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

template <class Element>
void append(std::vector<Element>& elements, std::vector<Element> more) {
  std::ranges::move(more, std::back_inserter(elements));
}

/// The limits on the size of control software, and its modules.
std::vector<SectionLine> size_lines(const Method& method) {
  if (method.architecture == Architecture::Network) return {};
  std::vector<SectionLine> lines;
  if (method.architecture == Architecture::Tree) {
    lines.push_back({"max_subtrees", std::to_string(method.max_subtrees)});
  } else {
    lines.push_back({"max_states", std::to_string(method.max_states)});
    lines.push_back({"max_transitions", std::to_string(method.max_transitions)});
  }
  lines.push_back({"behaviours", array_of(method.behaviours)});
  lines.push_back({"conditions", array_of(method.conditions)});
  return lines;
}

/// A complete flavour that is not built in; `prefix` is the method's prefix.
std::vector<Section> own_flavour_sections(const Flavour& flavour, const std::string& prefix) {
  const std::string header = "method.flavour";
  std::vector<Section> sections = flavour_sections(flavour, header);
  for (Section& section : sections)
    section.prefix.replace(0, std::string_view("method.").size(), prefix);
  return sections;
}

/// A method with the names of its modules.
void add_method(const Method& method, std::vector<Section>& sections) {
  const std::string prefix = "method." + method.name + ".";
  if (!method.parameters.empty()) {
    sections.push_back(parameter_file_section(method));
    append(sections.back().lines, search_lines(method));
    append(sections, search_sections(method, prefix));
    return;
  }
  Section section{"[[method]]",
                  prefix,
                  {{"name", quoted_text(method.name)},
                   {"flavour", quoted_text(method.flavour)},
                   {"turn_clock", quoted_text(name_of(method.turn_clock))}}};
  if (!method.baseline.empty()) section.lines.push_back({"baseline", quoted_text(method.baseline)});
  if (method.own_flavour != nullptr) section.lines.erase(section.lines.begin() + 1);
  const bool is_given = !method.baseline.empty() && method.baseline != kRandomMachine;
  if (!is_given) {
    append(section.lines, search_lines(method));
    append(section.lines, size_lines(method));
  }
  sections.push_back(std::move(section));
  if (method.own_flavour != nullptr)
    append(sections, own_flavour_sections(*method.own_flavour, prefix));
  if (!is_given) append(sections, search_sections(method, prefix));
  if (method.ranges.empty()) return;
  Section parameters{"[method.parameters]", prefix + "parameters.", {}};
  const auto flavour = flavour_of(method);
  for (const RangeOverride& range : method.ranges) {
    std::string type = "real";
    for (const ParameterSpec& parameter : (*flavour)->find(range.module)->parameters) {
      if (parameter.name != range.parameter) continue;
      if (parameter.type == ParameterSpec::Type::Integer) type = "int";
    }
    parameters.lines.push_back(
        {range.module + "." + range.parameter, "{ " + type + " = [" + number_text(range.lower) +
                                                   ", " + number_text(range.upper) + "] }"});
  }
  sections.push_back(std::move(parameters));
}

/// An enumerator by its name.
template <class Enum>
SectionLine choice_line(std::string_view key, const std::vector<std::string>& names, Enum value) {
  return {std::string(key), quoted_text(names.at(static_cast<std::size_t>(value)))};
}

/// Options that only races use.
void add_race_options(const Scenario& race, Section& section) {
  for (const IntegerOption& option : kIntegerOptions) {
    if (option.member != &Scenario::max_experiments)
      section.lines.push_back({std::string(option.key), std::to_string(race.*option.member)});
  }
  if (race.min_experiments) {
    section.lines.push_back({"min_experiments", std::to_string(*race.min_experiments)});
  }
  if (race.test_type)
    section.lines.push_back(choice_line("test_type", kTestTypes, *race.test_type));
  if (race.capping) section.lines.push_back({"capping", flag_text(*race.capping)});
  section.lines.push_back(choice_line("capping_type", kCappingTypes, race.capping_type));
  section.lines.push_back(choice_line("bound_type", kBoundTypes, race.bound_type));
  for (const RealOption& option : kRealOptions) {
    section.lines.push_back({std::string(option.key), number_text(race.*option.member)});
  }
  for (const FlagOption& option : kFlagOptions) {
    section.lines.push_back({std::string(option.key), flag_text(race.*option.member)});
  }
}

/// [race] with all options, even those with default values.
Section race_section(const Campaign& campaign) {
  const Scenario& race = campaign.race;
  Section section{"[race]", "race.", {}};
  // The budget may be a time instead.
  if (race.max_experiments > 0)
    section.lines.push_back({"max_experiments", std::to_string(race.max_experiments)});
  if (has_races(campaign)) add_race_options(race, section);
  section.lines.push_back({"digits", std::to_string(campaign.digits)});
  section.lines.push_back({"test_nb_elites", std::to_string(campaign.test_nb_elites)});
  section.lines.push_back({"test_iteration_elites", flag_text(campaign.test_iteration_elites)});
  if (campaign.only_test) section.lines.push_back({"only_test", flag_text(true)});
  if (race.ablation) {
    section.lines.push_back(choice_line("ablation", kAblationTypes, *race.ablation));
    section.lines.push_back({"ablation_pairs", std::to_string(race.ablation_pairs)});
  }
  if (!campaign.repair.empty()) {
    section.lines.push_back({"repair_configuration", quoted_text(campaign.repair)});
  }
  return section;
}

/// One profile of possibly several; the prefix contains its name, so that its keys differ from
/// those of other profiles.
std::vector<Section> test_profile_sections(const Profile& profile) {
  const std::string header = "tests.profile";
  std::vector<Section> sections = profile_sections(profile, header, true);
  for (Section& section : sections)
    section.prefix.insert(header.size(), "." + profile.name);
  return sections;
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
  for (const CampaignMission& mission : campaign.missions) {
    append(sections,
           campaign.target ? target_mission_sections(mission) : mission_sections(mission));
  }
  for (const Method& method : campaign.methods)
    add_method(method, sections);
  sections.push_back(race_section(campaign));
  if (campaign.target) {
    sections.push_back(target_section(*campaign.target));
  } else {
    sections.push_back({"[simulator]", "simulator.", {{"kind", "\"builtin\""}}});
    append(sections, profile_sections(campaign.profile, "simulator.profile"));
    for (const Profile& profile : campaign.test_profiles)
      append(sections, test_profile_sections(profile));
  }
  return sections;
}

}  // namespace swarmsmith
