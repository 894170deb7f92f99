#pragma once

#include <memory>
#include <vector>

#include "base/rng.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"
#include "irace_core/search/options.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

/// EvoStick's genetic algorithm: the best fifth of a generation goes on unchanged and is run again
/// on the next generation's pairs; the rest are mutated copies of these, each of a parent drawn
/// uniformly; no crossover. After the last generation the next one is made once more, and its best
/// mean on further pairs wins (ARGoS3-NEAT, params/evostick*.ne with NEAT 1.2.1; docs/methods.md).
/// Draws of generation g come from the stream "evolution" with index g. Errors: a space that is not
/// a RealBox, a budget that is too small.
Expected<std::unique_ptr<Strategy>> make_evolution(const ParameterSpace& space,
                                                   const Scenario& scenario,
                                                   const EvolutionOptions& options,
                                                   std::vector<Configuration> initial);

/// Changes weights, units as RealBox has them, each towards [-5, 5].
///
/// Neat: with probability 1/2 severely, each weight 70 % += U, 20 % = U, 10 % as it is; else each
/// weight += U, but those of the last fifth of ten weights or more 50 %, 20 % and 30 %. U is
/// uniform in (-step, step). Normal: each weight += a normal number of standard deviation `step`.
void mutate(std::vector<double>& weights, Mutation mutation, double step, Rng& rng);

}  // namespace swarmsmith::search
