#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "console/output.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// Reads the campaign file, or prints everything that is wrong with it (exit code 2). A `budget` of
/// a flag takes the place of the file's.
std::optional<Campaign> read_or_complain(const std::string& file, Output& output,
                                         std::optional<std::int64_t> budget = std::nullopt);

}  // namespace swarmsmith::cli
