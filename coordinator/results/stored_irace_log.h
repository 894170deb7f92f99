#pragma once

#include <cstdint>
#include <functional>

#include "base/expected.h"
#include "coordinator/results/irace_log.h"
#include "storage/store.h"

namespace swarmsmith {

/// Converts a design of a store to the log that R's irace would have written: the reverse of
/// irace_log_addition. Runs are in the order of the race's steps, elites first. If a
/// targetEvaluator changed a run's cost, its last value counts. A test instance has the number of
/// its test, since a log has a row for each test. `on_row` is called with the number of rows read
/// so far.
///
/// Errors: NotFound (no such design); BadInput (a design without a race, or one imported by a
/// version that did not keep the settings of the tuning); the store's errors.
Expected<IraceLog> stored_irace_log(StoreReader& store, DesignId design,
                                    const std::function<void(std::int64_t)>& on_row);

}  // namespace swarmsmith
