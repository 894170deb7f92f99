#pragma once

#include <memory>

#include "irace_core/iterated_race.h"
#include "irace_core/search/generations.h"
#include "irace_core/search/options.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

/// How random search spends its budget; the errors are those of make_random_search.
Expected<GenerationPlan> plan_random_search(std::int64_t budget, const RandomOptions& options);

/// Uniform draws in chunks of a thousand, all run on the same pairs; the best of all are run again
/// on further pairs, and the best mean there wins. Draw n is from the stream "random" of the seed
/// with index n, so that a smaller budget tries a prefix. `space` must outlive the strategy.
/// Errors: a budget that is too small, with the least that works.
Expected<std::unique_ptr<Strategy>> make_random_search(const ParameterSpace& space,
                                                       const Scenario& scenario,
                                                       const RandomOptions& options,
                                                       std::vector<Configuration> initial,
                                                       Repair repair);

/// A configuration drawn uniformly, repaired, and not forbidden; an error after 100 draws in vain.
Expected<Configuration> draw_uniform(const ParameterSpace& space, const Repair& repair, Rng& rng);

}  // namespace swarmsmith::search
