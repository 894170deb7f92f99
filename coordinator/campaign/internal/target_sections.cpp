#include "coordinator/campaign/internal/target_sections.h"

#include <algorithm>
#include <array>

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 6> kBatchModes = {"none",   "sge",   "pbs",
                                                         "torque", "slurm", "htcondor"};

}  // namespace

std::string array_of(const std::vector<std::string>& texts) {
  return "[" + list_of(texts, [](const std::string& text) { return quoted_text(text); }) + "]";
}

std::string block_text(const std::string& text) {
  const bool plain = std::ranges::all_of(text, [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return letter == '\n' || letter == '\t' || (code >= 0x20 && code != 0x7f);
  });
  const bool several = text.find('\n') != std::string::npos;
  if (!several || !plain || text.find("''") != std::string::npos || text.ends_with('\'')) {
    return quoted_text(text);
  }
  return "'''\n" + text + "'''";  // TOML ignores the first line break
}

std::vector<Section> target_mission_sections(const CampaignMission& mission) {
  const std::string prefix = "mission." + mission.mission.name + ".";
  const std::string test = mission.instances.test.empty()
                               ? "{ count = " + std::to_string(mission.test_count) + " }"
                               : array_of(mission.instances.test);
  return {{"[[mission]]", prefix, {{"name", quoted_text(mission.mission.name)}}},
          {"[mission.instances]",
           prefix + "instances.",
           {{"training", array_of(mission.instances.training)}, {"test", test}}}};
}

Section parameter_file_section(const Method& method) {
  Section section{
      "[[method]]",
      "method." + method.name + ".",
      {{"name", quoted_text(method.name)}, {"parameters_text", block_text(method.parameters)}}};
  if (!method.configurations.empty()) {
    section.lines.push_back({"configurations_text", block_text(method.configurations)});
  }
  return section;
}

/// Leaves out whether calls are repeated and how long a call may take, because neither changes the
/// results; includes the meaning of a time-out, because it does.
Section target_section(const Target& target) {
  Section section{"[simulator]",
                  "simulator.",
                  {{"kind", "\"command\""}, {"command", array_of({target.runner})}}};
  std::vector<SectionLine>& lines = section.lines;
  if (!target.launcher.empty()) lines.push_back({"launcher", quoted_text(target.launcher)});
  lines.push_back({"command_line", quoted_text(target.command_line)});
  if (!target.evaluator.empty()) lines.push_back({"evaluator", quoted_text(target.evaluator)});
  lines.push_back({"folder", quoted_text(target.folder)});
  lines.push_back({"retries", std::to_string(target.retries), false});
  lines.push_back({"timeout", quoted_text(std::to_string(target.timeout_s) + " s"),
                   target.timeout_is_rejection});
  lines.push_back({"on_timeout", target.timeout_is_rejection ? "\"reject\"" : "\"fail\""});
  lines.push_back({"aclib", flag_text(target.aclib)});
  lines.push_back(
      {"batch_mode", quoted_text(kBatchModes.at(static_cast<std::size_t>(target.batch_mode)))});
  return section;
}

}  // namespace swarmsmith
