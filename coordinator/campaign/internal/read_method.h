#pragma once

#include <vector>

#include "coordinator/campaign/campaign.h"
#include "sim/files/table_reader.h"

namespace swarmsmith {

/// The [[method]] tables of a campaign file, complete: modules that were not named are filled in,
/// in the order of the flavour's tables. What is wrong goes to the readers' complaints.
std::vector<Method> read_methods(TableReader& root);

/// The [race] table, into `scenario` and `digits`.
void read_race(TableReader& root, Scenario& scenario, std::int64_t& digits);

}  // namespace swarmsmith
