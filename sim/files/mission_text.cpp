#include <string_view>
#include <variant>

#include "base/overloaded.h"
#include "sim/files/internal/arena_text.h"
#include "sim/files/internal/score_text.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {
namespace {

/// The inline table `training`.
std::string placement_text(const Placement& placement) {
  return std::visit(
      Overloaded{[](const PlaceInDisc& disc) {
                   return "{ placement = \"uniform\", x = " + number_text(disc.centre.x) +
                          ", y = " + number_text(disc.centre.y) +
                          ", radius = " + number_text(disc.radius_m) + " }";
                 },
                 [](const PlaceInRectangle& rectangle) {
                   return "{ placement = \"rectangle\", " + rectangle_text(rectangle.area) + " }";
                 },
                 [](const PlaceAnywhere&) -> std::string { return "{ placement = \"anywhere\" }"; },
                 [](const PlaceAt& fixed) {
                   return "{ placement = \"fixed\", poses = [" +
                          list_of(fixed.poses,
                                  [](const Pose& pose) { return "{ " + pose_text(pose) + " }"; }) +
                          "] }";
                 }},
      placement);
}

}  // namespace

std::vector<Section> mission_sections(const MissionEntry& entry) {
  const Mission& mission = entry.mission;
  const std::string prefix = "mission." + mission.name + ".";
  const std::string duration =
      std::to_string(mission.cycles / 10) +
      (mission.cycles % 10 == 0 ? "" : "." + std::to_string(mission.cycles % 10)) + " s";
  const std::string count = std::to_string(entry.test_count);
  return {
      {"[[mission]]",
       prefix,
       {{"name", quoted_text(mission.name)},
        {"duration", quoted_text(duration)},
        {"robots", std::to_string(mission.robots)},
        {"robot", "{ " + outline_text(mission.body) + " }"}}},
      {"[mission.arena]", prefix + "arena.", arena_lines(mission)},
      {"[mission.score]", prefix + "score.", score_lines(mission.rule)},
      {"[mission.instances]",
       prefix + "instances.",
       {{"training", placement_text(mission.placement)}, {"test", "{ count = " + count + " }"}}}};
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
