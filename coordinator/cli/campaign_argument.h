#pragma once

#include <optional>
#include <string>

#include "coordinator/campaign/campaign.h"
#include "coordinator/cli/output.h"

namespace swarmsmith::cli {

/// Reads the campaign file, or prints everything that is wrong with it (exit code 2).
std::optional<Campaign> read_or_complain(const std::string& file, Output& output);

}  // namespace swarmsmith::cli
