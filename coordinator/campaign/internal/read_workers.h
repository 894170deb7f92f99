#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// Reads [workers]; its values do not change the answer. Paths are relative to `folder`.
void read_workers(TableReader& root, const std::filesystem::path& folder, Campaign& campaign);

/// Reads `bind` of a table and checks its form; whether the address is usable is found out only
/// when it is bound.
std::optional<std::string> read_bind(TableReader& table);

}  // namespace swarmsmith
