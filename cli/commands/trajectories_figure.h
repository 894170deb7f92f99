#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/figures/figure.h"
#include "cli/arguments/store_argument.h"
#include "storage/store.h"

namespace swarmsmith::cli {

inline constexpr std::size_t kMostTrajectories = 12;

/// Runs of one machine from above, side by side, with a row a robot and instant in the table. They
/// are simulated again: of the candidate, else of the winner of the design; on the seeds, else on
/// the first of the stored tests.
///
/// Errors: BadInput (no machine is named, a run cannot be simulated), NotFound (no such tests),
/// Conflict when a run is stored and does not come out again with the same bits.
Expected<Figure> trajectories_figure(std::unique_ptr<StoreReader> store,
                                     const FigureOptions& options,
                                     const std::vector<std::int64_t>& seeds,
                                     std::int64_t most_tests = 4);

/// The picture of the tests of a design's winner, for a report.
Expected<std::string> runs_from_above(const StoreArgument& argument, DesignId design);

}  // namespace swarmsmith::cli
