#pragma once

#include <filesystem>
#include <string>

#include "base/expected.h"
#include "cli/run/coordinator_link.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Carries out a command on the only campaign of a store: through the coordinator that runs it now,
/// else in the store itself, as `pause` and its like do. Returns a sentence that says what was
/// done, when it is on disk. Errors: as `command_by_wire` and `command_at_rest`; NotFound for a
/// design that the campaign does not have; Conflict for a store of several campaigns.
Expected<std::string> ask_campaign(const std::filesystem::path& path,
                                   const CoordinatorArgument& coordinator,
                                   const CommandRow& command);

}  // namespace swarmsmith::cli
