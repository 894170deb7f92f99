#include "coordinator/service/paused_designs.h"

namespace swarmsmith {

std::set<DesignId> paused_designs(std::span<const CommandRow> commands) {
  std::set<DesignId> paused;
  for (const CommandRow& command : commands) {
    if (command.kind == "pause") paused.insert(command.design);
    if (command.kind == "resume") paused.erase(command.design);
  }
  return paused;
}

std::string listed(std::span<const DesignId> designs) {
  std::string text;
  for (const DesignId design : designs)
    text += (text.empty() ? "" : ", ") + to_string(design);
  return text.empty() ? "none" : text;
}

std::string sentence_of_pause(const std::string& kind, std::span<const DesignId> designs) {
  const std::string state = kind == "pause" ? "paused" : "resumed";
  return designs.empty() ? "nothing to do: " + state + " before" : state + ": " + listed(designs);
}

}  // namespace swarmsmith
