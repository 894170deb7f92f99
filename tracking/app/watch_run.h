#pragma once

#include "tracking/app/run_analysis.h"
#include "tracking/app/run_plan.h"

namespace swarmsmith {

/// Looks through the plan's videos, once, and says how far it is. A layout that is to be measured
/// is, from pictures on the way, and goes into the run's log.
OrRefusal<AnalysedRun> watch_run(RunPlan& plan, Output& output);

/// What a word of FrameSource::open names, by its bytes (sha256_of_file): of a bag's topic, which
/// may be one of several cameras, the SHA-256 of that of the bag and the topic.
Expected<std::string> sha256_of_source(const std::string& word);

}  // namespace swarmsmith
