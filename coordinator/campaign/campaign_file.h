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

/// The campaign, or all errors in its file: `where` is file:line:column.
using CampaignOrErrors = tl::expected<Campaign, std::vector<Error>>;

/// Reads a campaign file (docs/campaign-file.md). Strict: unknown keys, wrong types and values,
/// unknown names, budgets that are too small for the race, and arenas that are too small for the
/// swarm are errors, all reported together. Paths in the file are relative to its folder; without
/// `store`, the store is the file's name with `.db`. A given `budget` replaces the file's budget,
/// and is not checked here: call `check_budget`.
CampaignOrErrors read_campaign(const std::filesystem::path& file,
                               std::optional<std::int64_t> budget = std::nullopt);

/// The same for a text; `file` is for error messages and gives the folder for paths; it is not
/// opened.
CampaignOrErrors parse_campaign(std::string_view text, const std::filesystem::path& file,
                                std::optional<std::int64_t> budget = std::nullopt);

/// The reason why a profile must not have this name, if there is one: a profile's name is the
/// source of its scores, and these would be mixed up with scores of robots or programs.
std::optional<std::string> complaint_about_source(const std::string& profile);

/// Checks whether the budget is large enough for each method's space, after command-line options
/// have changed the campaign; returns one error for each method whose race cannot run.
/// `read_campaign` does this unless it gets a budget.
std::vector<Error> check_budget(const Campaign& campaign);

/// The campaign that `run` runs without a file: color_selection with a watermelon design of a few
/// thousand experiments, a machine made by hand and a random one; the store is demo.db in the
/// current folder.
Campaign demo_campaign();

}  // namespace swarmsmith
