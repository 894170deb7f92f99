#pragma once

#include <filesystem>
#include <string>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Writes a command of a person (its kind, design, budget and who; no design: all that are not
/// over) into the store of a campaign that does not run; it acts when the campaign is run again.
/// Returns a sentence that says so. What cannot be is refused as a running coordinator would: the
/// design is played again for that, which takes as long as `verify` of it. `known` is the campaign
/// of the store. Errors: BadInput (with what can be done), Corrupt.
Expected<std::string> command_at_rest(Store& store, const CampaignRow& known,
                                      const std::filesystem::path& path, const CommandRow& command);

}  // namespace swarmsmith::cli
