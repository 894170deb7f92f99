#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

std::string to_text(const LauncherStatus& status) {
  std::string text = status.name + ": " + std::to_string(status.running) + " of " +
                     std::to_string(status.wanted) + " workers run";
  if (status.pending > 0) text += ", " + std::to_string(status.pending) + " wait";
  if (!status.waits_for.empty()) text += " (" + status.waits_for + ")";
  if (!status.note.empty()) text += "; " + status.note;
  return text;
}

}  // namespace swarmsmith
