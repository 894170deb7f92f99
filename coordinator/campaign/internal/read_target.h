#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// Reads the keys of [simulator] with kind = "command"; makes paths absolute, but does not check
/// the programs. Errors go to the reader's complaints.
Target read_target(TableReader& simulator, const std::filesystem::path& folder);

/// Reads the [[mission]] tables for evaluation by programs: names, and instances as texts.
std::vector<CampaignMission> read_target_missions(TableReader& root,
                                                  const std::filesystem::path& folder);

/// The path of a program: relative to `folder`, or found through PATH if nothing is there and the
/// name has no slash (irace facts, 21).
std::string program_path(const std::string& name, const std::filesystem::path& folder);

}  // namespace swarmsmith
