#pragma once

#include <cstdint>
#include <functional>

#include "base/expected.h"
#include "coordinator/results/irace_log.h"
#include "storage/store.h"

namespace swarmsmith {

/// A design of a store as the log that R's irace would have kept of it: the reverse of
/// irace_log_addition. Runs are in the order of the race's steps, elites first.
/// The last word of a targetEvaluator on a run is its cost. A test instance has the number of its
/// test, since a log has a row for each. `on_row` hears how many rows were read.
///
/// Errors: NotFound, no such design; BadInput, a design that no race made, or one that a version
/// imported which did not keep what was tuned; those of the store.
Expected<IraceLog> stored_irace_log(StoreReader& store, DesignId design,
                                    const std::function<void(std::int64_t)>& on_row);

}  // namespace swarmsmith
