#pragma once

#include <string>

#include "cli/arguments/thing_id.h"
#include "console/exit_code.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// How a design came to its winner, in the words of its search: its iterations, generations or
/// other parts with the best of each, and what the final stage said of the winner. `is_written`: a
/// process writes the store.
ExitCode explain_design(Output& output, StoreReader& store, const ThingId& id, bool is_written);

}  // namespace swarmsmith::cli
