#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/table_reader.h"

namespace swarmsmith {

/// The [mission.arena] table: walls and floor. False when walls were given that make no arena.
bool read_arena(TableReader& table, CampaignMission& mission);

/// A colour by name or number; the key must be there.
std::optional<Rgb> read_color(TableReader& table, std::string_view key);

/// The keys of a table whose keys are colours, in the order of the colours' own names, so that the
/// spelling decides nothing. Two spellings of one colour are a complaint.
std::vector<std::pair<std::string, Rgb>> read_color_keys(TableReader& table);

}  // namespace swarmsmith
