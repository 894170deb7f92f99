#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"
#include "irace_core/search.h"

namespace swarmsmith {

/// One step of the path from one configuration to another (irace's ablation; Fawcett and Hoos,
/// "Analysing differences between algorithm configurations through ablation", Journal of Heuristics
/// 22, 2016).
struct AblationChange {
  Configuration configuration;
  /// The parameters; the one that was chosen for the change comes first.
  std::vector<std::size_t> changed;
};

/// The parameters in which two configurations differ; two inactive values do not differ.
std::vector<std::size_t> differences(const Configuration& a, const Configuration& b);

/// For each of the parameters `open`, in their order: `current` with that parameter set to its
/// value in `target`. Parameters that become active by this take the target's value, and parameters
/// that become inactive lose theirs. Changes that give a forbidden configuration, or none of the
/// space, are left out: these parameters change later, together with others.
std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open);

/// The parameters that changed from `before` to `after` on the path to `target`: those of one
/// change, or all that were left at the end.
std::vector<std::size_t> change_between(const ParameterSpace& space, const Configuration& before,
                                        const Configuration& after, const Configuration& target);

/// The largest number of runs that the path can take.
std::int64_t most_ablation_runs(const Configuration& source, const Configuration& target,
                                std::int64_t pairs);

/// The path from the first of two configurations to the second, as a search with these iterations:
/// one for the source, one for each step, one for the target. All configurations are run on the
/// same `ablation_pairs` pairs of instance and seed. A step races the changes that are still open,
/// without elitism and capping, with the scenario's test (or runs all of them on all pairs). Its
/// elite is the best change by irace's overall ranks, or the first of several that are equal. The
/// elites of the last iteration are all configurations of the path, best first: one with results on
/// more pairs comes before one with fewer.
///
/// These options of the scenario have an effect: budget, seed, instances and their order, the test,
/// `bound_max`, and whether there is a targetEvaluator. It is an error if there are not exactly two
/// configurations, if they are equal, or if the budget is below most_ablation_runs.
Expected<std::unique_ptr<Search>> start_ablation(ParameterSpace space, const Scenario& scenario,
                                                 const std::vector<Configuration>& ends);

}  // namespace swarmsmith
