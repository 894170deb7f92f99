#pragma once

#include <set>
#include <span>
#include <string>

#include "storage/rows.h"

namespace swarmsmith {

/// The designs that are paused after a store's commands, in their order. Each "pause" and "resume"
/// names one design: a command to a whole campaign is a row for each design that it reached.
std::set<DesignId> paused_designs(std::span<const CommandRow> commands);

/// "d1, d2"; "none".
std::string listed(std::span<const DesignId> designs);
/// What a "pause" or "resume" did to these designs, for whoever asked.
std::string sentence_of_pause(const std::string& kind, std::span<const DesignId> designs);

}  // namespace swarmsmith
