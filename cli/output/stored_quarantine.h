#pragma once

#include <string>
#include <vector>

#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Who is in quarantine as the store has it: of a campaign at rest, and after a restart.
Expected<std::vector<QuarantineStatus>> stored_quarantine(StoreReader& store);

/// "in quarantine: ..." and how it ends; a line each, none without a worker in quarantine. `store`
/// as a person would type it.
std::vector<std::string> quarantine_lines(const std::vector<QuarantineStatus>& quarantine,
                                          const std::string& store);

/// In place of v_workers, for `ls`: its columns, and since when and why a worker is in quarantine.
std::string workers_with_quarantine();

}  // namespace swarmsmith::cli
