#pragma once

#include <map>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"
#include "irace_core/search/options.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A hash over what decides the answer (`deciding`): two campaigns of the same digest give the same
/// answer, whatever their store, workers, comments and order of keys.
std::string campaign_digest(const Campaign& campaign);

/// What a store keeps of the campaign.
CampaignRow campaign_row(const Campaign& campaign);

/// The campaign's designs: missions in the order of the file, methods within, repetitions within;
/// ids from 1. A design's seed follows from the campaign's and its id.
std::vector<DesignRow> design_rows(const Campaign& campaign);

/// How designs are searched for, by another search than iterated racing.
using Searches = std::map<DesignId, SearchOptions>;
Searches searches_of(const Campaign& campaign);

}  // namespace swarmsmith
