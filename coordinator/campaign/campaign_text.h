#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The campaign as a complete campaign file: nothing left to defaults and presets, always in the
/// same order, so that reading it gives the same campaign again, with any later version's presets.
/// Kept in the store. Where workers run is left out, where the store is as well.
std::string normalised_text(const Campaign& campaign);

/// The version of the engine that plays all of the campaign's missions, the highest of theirs.
int engine_version_of(const Campaign& campaign);

/// Exactly what decides the campaign's answer, as (key, value) in a fixed order: missions, methods,
/// profile, race options, seed, budget, repetitions, versions of engine and race. Keys read like
/// `mission.aggregation.robots`.
using Deciding = std::vector<std::pair<std::string, std::string>>;
Deciding deciding(const Campaign& campaign);

}  // namespace swarmsmith
