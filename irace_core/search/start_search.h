#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "irace_core/search.h"
#include "irace_core/search/options.h"

namespace swarmsmith {

/// The search of a design, with its first questions. The scenario's budget, seed and instances
/// count for all; the rest of it is for races. `neighbourhood` is for annealing alone; without one,
/// it changes one parameter at a time from a random start. A scenario with an ablation has that in
/// place of a search.
///
/// Errors: a budget that is too small, with the smallest one that works; a space that the search
/// cannot use; options of races that other searches do not know (capping, max_time, a
/// targetEvaluator, a deterministic target); a repair for cma-es, whose points would not be its
/// own.
Expected<std::unique_ptr<Search>> start_search(
    ParameterSpace space, const Scenario& scenario, const SearchOptions& options,
    std::vector<Configuration> initial = {}, Repair repair = {},
    std::optional<search::Neighbourhood> neighbourhood = {});

}  // namespace swarmsmith
