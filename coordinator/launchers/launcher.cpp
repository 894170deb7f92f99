#include "coordinator/launchers/launcher.h"

#include "base/plain_text.h"

namespace swarmsmith {

std::string to_text(const LauncherStatus& status) {
  std::string text = status.name + ": " + std::to_string(status.running) + " of " +
                     counted(status.wanted, "worker runs", "workers run");
  if (status.pending > 0) text += ", " + counted(status.pending, "waits", "wait");
  if (!status.waits_for.empty()) text += " (" + status.waits_for + ")";
  if (!status.note.empty()) text += "; " + status.note;
  return text;
}

}  // namespace swarmsmith
