#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// [workers]: nothing here decides the answer. Paths are relative to `folder`.
void read_workers(TableReader& root, const std::filesystem::path& folder, Campaign& campaign);

/// The `bind` of a table, checked for its form; whether it can be bound shows when it is.
std::optional<std::string> read_bind(TableReader& table);

}  // namespace swarmsmith
