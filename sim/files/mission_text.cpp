#include <string_view>
#include <variant>

#include "base/overloaded.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/files/color_text.h"
#include "sim/files/internal/arena_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/robot_file.h"
#include "sim/mission/score.h"

namespace swarmsmith {
namespace {

/// Writes a parameter as TOML.
struct ValueText {
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(Rgb value) const { return quoted_text(color_text(value)); }
  std::string operator()(When value) const { return quoted_text(name_of(value)); }
  std::string operator()(const std::string& value) const { return quoted_text(value); }

  /// An inline table, in the order of the rule.
  std::string operator()(const std::vector<Reward>& value) const {
    std::string text;
    for (const Reward& reward : value) {
      text +=
          (text.empty() ? "" : ", ") + color_key(reward.color) + " = " + number_text(reward.reward);
    }
    return "{ " + text + " }";
  }
};

/// The lines of [mission.score], which `read_score` reads back to the same rule.
std::vector<SectionLine> score_lines(const ScoreRule& rule) {
  std::vector<SectionLine> lines = {{"kind", quoted_text(kind_of(rule))}};
  const auto add = [&](const ScoreField& field, const auto& value) {
    lines.push_back({std::string(field.key), ValueText()(value)});
  };
  visit_fields(rule, add);
  return lines;
}

/// The keys of a placement.
std::string placement_keys(const Placement& placement) {
  return std::visit(
      Overloaded{[](const PlaceInDisc& disc) {
                   return "placement = \"uniform\", x = " + number_text(disc.centre.x) +
                          ", y = " + number_text(disc.centre.y) +
                          ", radius = " + number_text(disc.radius_m);
                 },
                 [](const PlaceInRectangle& rectangle) {
                   return "placement = \"rectangle\", " + rectangle_text(rectangle.area);
                 },
                 [](const PlaceAnywhere&) -> std::string { return "placement = \"anywhere\""; },
                 [](const PlaceAt& fixed) {
                   return "placement = \"fixed\", poses = [" +
                          list_of(fixed.poses,
                                  [](const Pose& pose) { return "{ " + pose_text(pose) + " }"; }) +
                          "]";
                 }},
      placement);
}

/// The inline table `training`; texts of earlier missions have no `ignores_obstacles`.
std::string placement_text(const Mission& mission) {
  return "{ " + placement_keys(mission.placement) +
         (mission.ignores_obstacles ? ", ignores_obstacles = true }" : " }");
}

/// The RVR is written only as its outline, as in all earlier texts; other robots are written
/// completely.
void add_robot(const Mission& mission, const std::string& prefix, std::vector<Section>& sections) {
  const Robot& robot = mission.robot;
  if (is_rvr(robot)) {
    sections.front().lines.push_back({"robot", "{ " + outline_text(robot.body.outline) + " }"});
    return;
  }
  constexpr std::string_view kHeader = "mission.";
  for (Section& section : robot_sections(robot, std::string(kHeader) + "robot")) {
    section.prefix = prefix + section.prefix.substr(kHeader.size());
    sections.push_back(std::move(section));
  }
}

}  // namespace

std::vector<Section> mission_sections(const MissionEntry& entry) {
  const Mission& mission = entry.mission;
  const std::string prefix = "mission." + mission.name + ".";
  const std::string duration =
      std::to_string(mission.cycles / 10) +
      (mission.cycles % 10 == 0 ? "" : "." + std::to_string(mission.cycles % 10)) + " s";
  const std::string count = std::to_string(entry.test_count);
  std::vector<Section> sections = {{"[[mission]]",
                                    prefix,
                                    {{"name", quoted_text(mission.name)},
                                     {"duration", quoted_text(duration)},
                                     {"robots", std::to_string(mission.robots)}}}};
  add_robot(mission, prefix, sections);
  sections.push_back({"[mission.arena]", prefix + "arena.", arena_lines(mission)});
  sections.push_back({"[mission.score]", prefix + "score.", score_lines(mission.rule)});
  sections.push_back(
      {"[mission.instances]",
       prefix + "instances.",
       {{"training", placement_text(mission)}, {"test", "{ count = " + count + " }"}}});
  return sections;
}

std::string mission_text(const MissionEntry& entry) {
  std::vector<Section> sections = mission_sections(entry);
  Section& top = sections.front();
  top.header.clear();
  top.lines.insert(top.lines.begin(), {"format", "1"});
  constexpr std::string_view kPart = "[mission.";
  for (Section& section : sections) {
    if (section.header.starts_with(kPart))
      section.header = "[" + section.header.substr(kPart.size());
  }
  return text_of(sections);
}

}  // namespace swarmsmith
