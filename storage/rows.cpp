#include "storage/rows.h"

#include <algorithm>
#include <array>

#include "base/overloaded.h"
#include "base/text/toml_text.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

/// In the order of the enum.
constexpr std::array<std::string_view, 6> kCommands = {"unknown", "pause",  "resume",
                                                       "cancel",  "extend", "forgive"};

void append_string(std::string& out, std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      out += "\\u00";
      out += {kDigits[byte >> 4U], kDigits[byte & 15U]};
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  out += '"';
}

}  // namespace

std::string_view word_of(DesignState state) {
  switch (state) {
    case DesignState::Waiting:
      return "waiting";
    case DesignState::Racing:
      return "racing";
    case DesignState::Testing:
      return "testing";
    case DesignState::Finished:
      return "finished";
    case DesignState::Stopped:
      return "stopped";
  }
  return {};
}

std::optional<DesignState> design_state_of(std::string_view word) {
  const std::vector<DesignState> all = all_design_states();
  const auto found = std::ranges::find(all, word, [](DesignState state) { return word_of(state); });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::string_view word_of(CommandKind kind) {
  return kCommands.at(static_cast<std::size_t>(kind));
}

CommandKind command_kind_of(std::string_view word) {
  const auto found = std::ranges::find(kCommands, word);
  return found == kCommands.end() ? CommandKind::Unknown
                                  : static_cast<CommandKind>(found - kCommands.begin());
}

bool is_blamed_by_process(std::string_view principal) {
  return principal.find('@') == std::string_view::npos && !principal.starts_with("local ");
}

std::optional<Quarantine> quarantine_of(const WorkerRow& row) {
  if (row.state != WorkerState::Quarantined || row.principal.empty()) return std::nullopt;
  const bool is_one = row.client.empty() && is_blamed_by_process(row.principal);
  return Quarantine{.principal = row.principal, .identity = is_one ? row.identity : ""};
}

EventRow event_row(std::string severity, std::string kind, std::vector<EventField> fields) {
  std::string text = "{";
  for (const auto& [key, value] : fields) {
    if (text.size() > 1) text += ',';
    append_string(text, key);
    text += ':';
    std::visit(Overloaded{[&](std::int64_t number) { text += std::to_string(number); },
                          [&](double number) { text += number_text(number); },
                          [&](const std::string& word) { append_string(text, word); }},
               value);
  }
  return {std::move(severity), std::move(kind), text + "}", std::move(fields)};
}

}  // namespace swarmsmith
