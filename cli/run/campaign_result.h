#pragma once

#include <string>

#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The answer of a campaign, from its store: each design's best machine with its mean score in the
/// race and, with the 95 % interval of the mean, on fresh seeds. As a table and the machines'
/// texts, or as the event {"v":1,"event":"done","designs":[...]}. `name` of the campaign: when it
/// is not the only one.
ExitCode write_result(Output& output, StoreReader& store, const std::string& name = {});

/// Suggested commands for the store.
void print_next_steps(Output& output, const std::string& store, bool is_demo);

}  // namespace swarmsmith::cli
