#pragma once

#include <filesystem>
#include <string>

#include "base/expected.h"
#include "cli/run/coordinator_link.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Carries out a command on the only campaign of a store: through the coordinator that runs it now,
/// else in the store itself, as for `pause`. Returns a sentence that says what was done, once the
/// command is on disk. Errors: as for `command_by_wire` and `command_at_rest`; NotFound if the
/// campaign does not have the design; Conflict for a store of several campaigns.
Expected<std::string> ask_campaign(const std::filesystem::path& path,
                                   const CoordinatorArgument& coordinator,
                                   const CommandRow& command);

}  // namespace swarmsmith::cli
