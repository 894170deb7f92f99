#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The campaign as a complete campaign file: it relies on no defaults or presets and always has the
/// same order, so that reading it gives the same campaign again, even with the presets of a later
/// version. The store keeps it. It omits where workers run and where the store is.
std::string normalised_text(const Campaign& campaign);

/// The version of the engine that simulates all of the campaign's missions: the highest version
/// that one of them needs.
int engine_version_of(const Campaign& campaign);

/// Exactly the values that decide the campaign's answer, as (key, value) in a fixed order:
/// missions, methods, profile, race options, seed, budget, repetitions, versions of engine and
/// race. Keys look like `mission.aggregation.robots`.
using Deciding = std::vector<std::pair<std::string, std::string>>;
Deciding deciding(const Campaign& campaign);

}  // namespace swarmsmith
