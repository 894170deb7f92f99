#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// The designs that are paused after a store's commands, in their order. Each "pause" and "resume"
/// names one design: a command to a whole campaign is a row for each design that it reached.
std::set<DesignId> paused_designs(std::span<const CommandRow> commands);

/// What a command leaves of those that are paused; only "pause" and "resume" change them.
void apply_pause(const CommandRow& command, std::set<DesignId>& paused);

/// The rows of a "pause" or "resume" to one design or, without one, to all that are `unfinished`: a
/// row for each design that it changes, without numbers. Asking twice changes nothing. Nothing when
/// it names a design that is not among the unfinished ones.
std::optional<std::vector<CommandRow>> rows_of_pause(const CommandRow& command,
                                                     std::vector<DesignId> unfinished,
                                                     const std::set<DesignId>& paused);

/// "d1, d2"; "none".
std::string listed(std::span<const DesignId> designs);
/// What a "pause" or "resume" did by these rows, for the client.
std::string sentence_of_pause(CommandKind kind, std::span<const CommandRow> rows);

}  // namespace swarmsmith
