#include "tracking/report/internal/reality_table.h"

#include <fmt/format.h>

namespace swarmsmith {
namespace {

std::string gain_text(const Gain& gain) {
  if (!gain.gain) return "cannot be determined: " + gain.reason;
  return fmt::format("{:.1f} +- {:.1f}", 100 * *gain.gain, 100 * gain.error);
}

std::string neighbours_text(const NeighboursSeen& seen) {
  if (!seen.is_told()) return "cannot be determined: " + seen.reason;
  return fmt::format("{:.1f} +- {:.1f} of {}", 100 * seen.miss_rate(), 100 * seen.error,
                     seen.there);
}

std::string states_text(const Reality& reality) {
  std::string text;
  for (const auto& [state, seconds] : reality.states_s)
    text += fmt::format("{}{}: {:.1f}", text.empty() ? "" : ", ", state, seconds);
  return text;
}

}  // namespace

HtmlTable reality_table(const RunFindings& run) {
  HtmlTable table{.caption =
                      "What logs and film show together: which part of the commanded way and turn "
                      "the robots made, and how many of the robots in reach a robot did not "
                      "notice. `swarmsmith track profile` makes a simulator's profile of it.",
                  .columns = {{"Robot"},
                              {"Way, of that commanded (%)"},
                              {"Turn, of that commanded (%)"},
                              {"Neighbours missed (%)"},
                              {"Seconds by state"}}};
  for (const RobotFinding& robot : run.robots) {
    if (robot.reality == nullptr) continue;
    const Reality& reality = *robot.reality;
    table.rows.push_back({robot.tracked->name, gain_text(reality.slip.way),
                          gain_text(reality.slip.turn), neighbours_text(reality.neighbours),
                          states_text(reality)});
  }
  return table;
}

}  // namespace swarmsmith
