#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// A campaign, or everything that is wrong with its file: `where` is file:line:column.
using CampaignOrErrors = tl::expected<Campaign, std::vector<Error>>;

/// Reads a campaign file (docs/campaign-file.md). Strict: unknown keys, wrong types and values,
/// names that nothing has, budgets that are too small for the race and arenas too small for the
/// swarm are errors, all reported together. Paths in the file are relative to its folder; without
/// `store` it is the file's name with `.db`. A `budget` from elsewhere takes the place of the
/// file's, which is then not judged: `check_budget` does it.
CampaignOrErrors read_campaign(const std::filesystem::path& file,
                               std::optional<std::int64_t> budget = std::nullopt);

/// The same for a text; `file` gives the name for errors and the folder for paths, and is not read.
CampaignOrErrors parse_campaign(std::string_view text, const std::filesystem::path& file,
                                std::optional<std::int64_t> budget = std::nullopt);

/// Whether budget and spaces of a campaign fit, after flags have changed it: the sentences of the
/// methods for which they don't. `read_campaign` has done it, unless it was given a budget.
std::vector<Error> check_budget(const Campaign& campaign);

/// The campaign that `run` runs without a file: color_selection, a watermelon design of a few
/// thousand experiments beside a machine by hand and a random one, store demo.db in the current
/// folder.
Campaign demo_campaign();

}  // namespace swarmsmith
