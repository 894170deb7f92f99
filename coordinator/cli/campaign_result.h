#pragma once

#include "coordinator/cli/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The answer of a campaign, from its store: each design's best machine with its scores in race and
/// test. As a table and the machines' texts, or as the event
/// {"v":1,"event":"done","designs":[...]}.
ExitCode write_result(Output& output, StoreReader& store);

}  // namespace swarmsmith::cli
