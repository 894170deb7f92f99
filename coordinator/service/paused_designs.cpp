#include "coordinator/service/paused_designs.h"

#include <algorithm>

namespace swarmsmith {

std::set<DesignId> paused_designs(std::span<const CommandRow> commands) {
  std::set<DesignId> paused;
  for (const CommandRow& command : commands)
    apply_pause(command, paused);
  return paused;
}

void apply_pause(const CommandRow& command, std::set<DesignId>& paused) {
  if (command.kind == CommandKind::Pause) paused.insert(command.design);
  if (command.kind == CommandKind::Resume) paused.erase(command.design);
}

std::optional<std::vector<CommandRow>> rows_of_pause(const CommandRow& command,
                                                     std::vector<DesignId> unfinished,
                                                     const std::set<DesignId>& paused) {
  if (command.design) {
    if (std::ranges::find(unfinished, command.design) == unfinished.end()) return std::nullopt;
    unfinished = {command.design};
  }
  std::vector<CommandRow> rows;
  for (const DesignId design : unfinished) {
    if (paused.contains(design) == (command.kind == CommandKind::Pause)) continue;
    rows.push_back(command);
    rows.back().design = design;
  }
  return rows;
}

std::string listed(std::span<const DesignId> designs) {
  std::string text;
  for (const DesignId design : designs)
    text += (text.empty() ? "" : ", ") + to_string(design);
  return text.empty() ? "none" : text;
}

std::string sentence_of_pause(CommandKind kind, std::span<const CommandRow> rows) {
  const std::string state = kind == CommandKind::Pause ? "paused" : "resumed";
  if (rows.empty()) return "nothing to do: every design is over, or already " + state;
  std::vector<DesignId> designs;
  for (const CommandRow& row : rows)
    designs.push_back(row.design);
  return state + ": " + listed(designs);
}

}  // namespace swarmsmith
