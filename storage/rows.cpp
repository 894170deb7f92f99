#include "storage/rows.h"

#include <algorithm>
#include <array>

namespace swarmsmith {
namespace {

/// By the enum's number.
constexpr std::array<std::string_view, 5> kStates = {"waiting", "racing", "testing", "finished",
                                                     "stopped"};
constexpr std::array<std::string_view, 5> kCommands = {"unknown", "pause", "resume", "cancel",
                                                       "extend"};

}  // namespace

std::string_view word_of(DesignState state) {
  return kStates.at(static_cast<std::size_t>(state));
}

std::optional<DesignState> design_state_of(std::string_view word) {
  const auto found = std::ranges::find(kStates, word);
  if (found == kStates.end()) return std::nullopt;
  return static_cast<DesignState>(found - kStates.begin());
}

std::string_view word_of(CommandKind kind) {
  return kCommands.at(static_cast<std::size_t>(kind));
}

CommandKind command_kind_of(std::string_view word) {
  const auto found = std::ranges::find(kCommands, word);
  return found == kCommands.end() ? CommandKind::Unknown
                                  : static_cast<CommandKind>(found - kCommands.begin());
}

}  // namespace swarmsmith
