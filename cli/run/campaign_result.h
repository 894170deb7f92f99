#pragma once

#include <string>

#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Prints the result of a campaign from its store: each design's best machine with its mean score
/// in the race and its mean on fresh seeds with the 95 % interval. As a table and the machines'
/// texts, or as the event {"v":1,"event":"done","designs":[...]}. `name`: of the campaign, if there
/// are several.
ExitCode write_result(Output& output, StoreReader& store, const std::string& name = {});

/// Prints suggested commands for the store. `has_winner`: whether there is a machine to look at.
void print_next_steps(Output& output, const std::string& store, bool has_winner, bool is_demo);

}  // namespace swarmsmith::cli
