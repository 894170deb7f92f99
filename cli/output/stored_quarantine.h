#pragma once

#include <string>
#include <vector>

#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The workers in quarantine according to the store: for a campaign that does not run, or after a
/// restart.
Expected<std::vector<QuarantineStatus>> stored_quarantine(StoreReader& store);

/// "in quarantine: ..." and how the quarantine ends, one line each; empty if no worker is in
/// quarantine. `store`: the path, as a person would type it.
std::vector<std::string> quarantine_lines(const std::vector<QuarantineStatus>& quarantine,
                                          const std::string& store);

/// SQL of a table that replaces v_workers in `ls`: its columns, and since when and why a worker is
/// in quarantine.
std::string workers_with_quarantine();

}  // namespace swarmsmith::cli
