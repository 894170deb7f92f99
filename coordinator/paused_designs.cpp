#include "coordinator/paused_designs.h"

namespace swarmsmith {

std::set<DesignId> paused_designs(std::span<const CommandRow> commands) {
  std::set<DesignId> paused;
  for (const CommandRow& command : commands) {
    if (command.kind == "pause") paused.insert(command.design);
    if (command.kind == "resume") paused.erase(command.design);
  }
  return paused;
}

}  // namespace swarmsmith
