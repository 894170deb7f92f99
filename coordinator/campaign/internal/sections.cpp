#include "coordinator/campaign/internal/sections.h"

#include <variant>

#include "base/overloaded.h"
#include "coordinator/campaign/internal/color_text.h"
#include "coordinator/campaign/internal/race_options.h"
#include "coordinator/campaign/internal/score_text.h"
#include "coordinator/campaign/internal/table_reader.h"
#include "sim/control/flavour.h"

namespace swarmsmith {
namespace {

/// The items' texts, separated by commas.
template <class Items, class Text>
std::string list_of(const Items& items, const Text& text_of) {
  std::string text;
  for (const auto& item : items)
    text += (text.empty() ? "" : ", ") + text_of(item);
  return text;
}

/// A TOML array of texts.
std::string array_of(const std::vector<std::string>& texts) {
  return "[" + list_of(texts, [](const std::string& text) { return quoted_text(text); }) + "]";
}

std::string flag_text(bool flag) {
  return flag ? "true" : "false";
}

/// The keys of a place; squares are written as rectangles, too.
std::string rectangle_text(const Rectangle& shape) {
  return "x = " + number_text(shape.centre.x) + ", y = " + number_text(shape.centre.y) +
         ", width = " + number_text(shape.width_m) + ", height = " + number_text(shape.height_m);
}

/// An inline table of `spots`.
std::string spot_text(const Patch& patch) {
  const std::string shape =
      std::visit(Overloaded{[](const Disc& disc) {
                              return "shape = \"circle\", x = " + number_text(disc.centre.x) +
                                     ", y = " + number_text(disc.centre.y) +
                                     ", diameter = " + number_text(2 * disc.radius_m);
                            },
                            [](const Rectangle& rectangle) {
                              return "shape = \"rectangle\", " + rectangle_text(rectangle);
                            }},
                 patch.shape);
  return "{ " + shape + ", color = " + quoted_text(color_text(patch.color)) + " }";
}

/// The inline table `shuffled`.
std::string shuffled_text(const ShuffledPatches& shuffled) {
  const std::string colors = list_of(shuffled.shares, [](const ShuffledPatches::Share& share) {
    return color_key(share.color) + " = " + std::to_string(share.count);
  });
  const std::string places = list_of(
      shuffled.places, [](const Rectangle& place) { return "{ " + rectangle_text(place) + " }"; });
  return "{ colors = { " + colors + " }, places = [" + places + "] }";
}

/// [mission.arena]; without an area the walls are the thesis' own.
std::vector<SectionLine> arena_lines(const CampaignMission& campaign_mission) {
  const Mission& mission = campaign_mission.mission;
  std::vector<SectionLine> lines = {{"shape", "\"dodecagon\""}};
  if (campaign_mission.area_m2) lines.push_back({"area", number_text(*campaign_mission.area_m2)});
  lines.push_back({"floor", quoted_text(color_text(mission.arena.floor))});
  lines.push_back({"spots", "[" + list_of(mission.arena.patches, spot_text) + "]"});
  if (!mission.shuffled.places.empty()) {
    lines.push_back({"shuffled", shuffled_text(mission.shuffled)});
  }
  return lines;
}

/// A mission is told whole: its preset may change in a later version, its stored text must not.
void add_mission(const CampaignMission& campaign_mission, std::vector<Section>& sections) {
  const Mission& mission = campaign_mission.mission;
  const std::string prefix = "mission." + mission.name + ".";
  const std::string duration =
      std::to_string(mission.cycles / 10) +
      (mission.cycles % 10 == 0 ? "" : "." + std::to_string(mission.cycles % 10)) + " s";
  sections.push_back({"[[mission]]",
                      prefix,
                      {{"name", quoted_text(mission.name)},
                       {"duration", quoted_text(duration)},
                       {"robots", std::to_string(mission.robots)}}});
  sections.push_back({"[mission.arena]", prefix + "arena.", arena_lines(campaign_mission)});
  sections.push_back({"[mission.score]", prefix + "score.", score_lines(mission.rule)});
  const std::string radius = number_text(std::get<PlaceInDisc>(mission.placement).radius_m);
  const std::string count = std::to_string(campaign_mission.test_count);
  sections.push_back({"[mission.instances]",
                      prefix + "instances.",
                      {{"training", "{ placement = \"uniform\", radius = " + radius + " }"},
                       {"test", "{ count = " + count + " }"}}});
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

std::string quoted_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + "\"";
}

std::vector<Section> sections_of(const Campaign& campaign) {
  std::vector<Section> sections;
  sections.push_back({"", "", {{"format", "1", false}}});
  sections.push_back({"[campaign]",
                      "campaign.",
                      {{"name", quoted_text(campaign.name), false},
                       {"seed", std::to_string(campaign.seed)},
                       {"repetitions", std::to_string(campaign.repetitions)}}});
  for (const CampaignMission& mission : campaign.missions)
    add_mission(mission, sections);
  for (const Method& method : campaign.methods)
    add_method(method, sections);
  sections.push_back(race_section(campaign));
  sections.push_back({"[simulator]",
                      "simulator.",
                      {{"kind", "\"builtin\""}, {"profile", quoted_text(campaign.profile.name)}}});
  return sections;
}

}  // namespace swarmsmith
