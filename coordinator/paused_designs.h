#pragma once

#include <set>
#include <span>

#include "storage/rows.h"

namespace swarmsmith {

/// The designs that are paused after a store's commands, in their order. Each "pause" and "resume"
/// names one design: a command to a whole campaign is a row for each design that it reached.
std::set<DesignId> paused_designs(std::span<const CommandRow> commands);

}  // namespace swarmsmith
