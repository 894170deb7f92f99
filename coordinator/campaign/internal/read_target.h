#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The keys of [simulator] with kind = "command"; paths are made absolute, programs are not looked
/// at. What is wrong goes to the reader's complaints.
Target read_target(TableReader& simulator, const std::filesystem::path& folder);

/// The [[mission]] tables of a campaign whose evaluations are programs: names, and instances as
/// texts.
std::vector<CampaignMission> read_target_missions(TableReader& root,
                                                  const std::filesystem::path& folder);

/// A program as a path: from `folder` on, or, when nothing is there and the name has no slash, as
/// PATH finds it (irace facts, 21).
std::string program_path(const std::string& name, const std::filesystem::path& folder);

}  // namespace swarmsmith
