#pragma once

#include <string>

#include "cli/arguments/thing_id.h"
#include "console/exit_code.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Explains how a design found its winner, in the terms of its search: its iterations, generations
/// or other parts with the best candidate of each, and the winner's result in the final stage.
/// `is_written`: a process is writing the store.
ExitCode explain_design(Output& output, StoreReader& store, const ThingId& id, bool is_written);

}  // namespace swarmsmith::cli
