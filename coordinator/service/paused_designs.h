#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// The designs that are paused after all commands of a store, applied in order. Each "pause" or
/// "resume" names one design: a command to a whole campaign is stored as one row per affected
/// design.
std::set<DesignId> paused_designs(std::span<const CommandRow> commands);

/// Applies a command to the set of paused designs; only "pause" and "resume" change it.
void apply_pause(const CommandRow& command, std::set<DesignId>& paused);

/// The rows of a "pause" or "resume" of one design, or of all `unfinished` designs if it names
/// none. There is a row for each design whose state changes, without a number, so that repeating a
/// command gives no rows. None if the command names a design that is not among the unfinished ones.
std::optional<std::vector<CommandRow>> rows_of_pause(const CommandRow& command,
                                                     std::vector<DesignId> unfinished,
                                                     const std::set<DesignId>& paused);

/// "d1, d2", or "none".
std::string listed(std::span<const DesignId> designs);
/// What a "pause" or "resume" with these rows did, for the client.
std::string sentence_of_pause(CommandKind kind, std::span<const CommandRow> rows);

}  // namespace swarmsmith
