#pragma once

#include <map>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"
#include "irace_core/search/options.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A hash over everything that decides the answer (`deciding`): two campaigns with the same digest
/// give the same answer, whatever their store, workers, comments and order of keys.
std::string campaign_digest(const Campaign& campaign);

/// The campaign's row in its store.
CampaignRow campaign_row(const Campaign& campaign);

/// The budget of each design of the method on the mission; 0 if the budget is a time, and without a
/// race.
std::int64_t design_budget(const Campaign& campaign, const CampaignMission& mission,
                           const Method& method);

/// The campaign's designs, sorted by mission in the order of the file, then by method, then by
/// repetition; ids start at 1. A design's seed is derived from the campaign's seed and the design's
/// id.
std::vector<DesignRow> design_rows(const Campaign& campaign);

/// The search options of designs that use another search than iterated racing.
using Searches = std::map<DesignId, SearchOptions>;
Searches searches_of(const Campaign& campaign);

}  // namespace swarmsmith
