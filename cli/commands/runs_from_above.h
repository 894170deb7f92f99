#pragma once

#include <string>

#include "base/expected.h"
#include "cli/arguments/store_argument.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// A picture of the test runs of a design's winner, for a report (trajectories_figure.cpp).
Expected<std::string> runs_from_above(const StoreArgument& argument, DesignId design);

}  // namespace swarmsmith::cli
