#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "irace_core/search.h"
#include "irace_core/search/options.h"

namespace swarmsmith {

/// Starts the search of a design, with its first questions. All searches use the scenario's budget,
/// seed and instances; only races use its other options. `neighbourhood` is only for annealing;
/// without it, annealing changes one parameter at a time. If the scenario has an ablation, that is
/// started instead of a search.
///
/// Errors: a budget that is too small, with the smallest one that works; a space that the search
/// cannot use; options of races that other searches do not have (capping, max_time, a
/// targetEvaluator, a deterministic target); a repair for a search other than irace, f-race and
/// random, since the others continue from the configurations that they made, not from repaired
/// ones.
Expected<std::unique_ptr<Search>> start_search(
    ParameterSpace space, const Scenario& scenario, const SearchOptions& options,
    std::vector<Configuration> initial = {}, Repair repair = {},
    std::optional<search::Neighbourhood> neighbourhood = {});

}  // namespace swarmsmith
