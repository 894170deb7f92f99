#pragma once

#include <optional>
#include <string>

#include "tracking/app/refusal.h"
#include "tracking/app/run_analysis.h"

namespace swarmsmith {

/// Refuses a run that is, in part, at the same time of the same film as another run of the store:
/// it is that run with another start or other cameras, and would count twice. Exit code 3. Other
/// runs of the film get a note. `key` is the run's in the store, which knows a run with the same
/// key. `own` is the run of the store that is scored again.
OrRefusal<void> check_same_film(const AnalysedRun& run, const std::string& key,
                                const std::string& store, std::optional<RealRunId> own,
                                Output& output);

}  // namespace swarmsmith
