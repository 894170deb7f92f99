#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/rng.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"
#include "irace_core/search/options.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

inline constexpr std::int64_t kAnnealingBlock = 100;  ///< iterations of it in one of the events

/// Whether there is room for a further iteration before the final stage.
bool walks_on(const AnnealingOptions& options, std::int64_t budget, std::int64_t used);
/// The temperature of iteration `number`, from 1, as it is shown: in the unit of the
/// options, and in score units where it is the published one.
double told_temperature(const AnnealingOptions& options, std::int64_t budget, std::int64_t used,
                        std::int64_t number);

/// What local search walks in.
struct Neighbourhood {
  /// Where it starts.
  Configuration start;
  /// A valid configuration beside the given one.
  std::function<Expected<Configuration>(const Configuration&, Rng&)> perturb;
};

/// The neighbourhood of any space: one active parameter gets another value, drawn uniformly;
/// parameters that become active with it are drawn, too. `space` must outlive it.
Neighbourhood one_parameter_neighbourhood(const ParameterSpace& space, Configuration start);

/// Simulated annealing in the manner of IcePop (docs/methods.md). A window of pairs moves on with
/// each iteration: the incumbent and the best so far are run on its new pairs, the perturbed
/// configuration on all. It is accepted when it is not worse by the window's mean, else with the
/// probability exp(-loss / T); T = 0 throughout is iterative improvement. All runs count. The best
/// and the last incumbent are run again at the end on further pairs, and the better mean wins.
///
/// Twenty random configurations on the first window say what a temperature of 1 is: the standard
/// deviation of their means. Iteration i draws from the stream "perturb" with index i. Errors: a
/// budget that is too small. It cannot be extended, since its temperatures follow from the budget.
Expected<std::unique_ptr<Strategy>> make_annealing(const ParameterSpace& space,
                                                   const Scenario& scenario,
                                                   const AnnealingOptions& options,
                                                   Neighbourhood neighbourhood);

}  // namespace swarmsmith::search
