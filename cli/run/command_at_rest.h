#pragma once

#include <filesystem>
#include <string>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Writes a user's command (its kind, design, budget and user; without a design it applies to all
/// unfinished ones) into the store of a campaign that does not run. The command takes effect when
/// the campaign runs again. Returns a sentence that says so. Refuses impossible commands as a
/// running coordinator would; to check this, the design is replayed, which takes as long as
/// `verify` of it. `known` is the campaign of the store. Errors: BadInput (with advice), Corrupt.
Expected<std::string> command_at_rest(Store& store, const CampaignRow& known,
                                      const std::filesystem::path& path, const CommandRow& command);

}  // namespace swarmsmith::cli
