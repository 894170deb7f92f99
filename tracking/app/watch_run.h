#pragma once

#include "tracking/app/run_analysis.h"
#include "tracking/app/run_plan.h"

namespace swarmsmith {

/// Reads the plan's videos once, and shows the progress. If the log asks for a measured layout, it
/// is measured from some of the pictures and added to the run's log.
OrRefusal<AnalysedRun> watch_run(RunPlan& plan, Output& output);

/// The digest of a source of FrameSource::open, over its contents (sha256_of_file). A bag may
/// contain the topics of several cameras, so with a topic it is the SHA-256 of the bag's digest and
/// the topic.
Expected<std::string> sha256_of_source(const std::string& word);

}  // namespace swarmsmith
