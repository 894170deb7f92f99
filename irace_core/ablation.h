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

/// One step of the way from a configuration to another one (irace's ablation; Fawcett and Hoos,
/// "Analysing differences between algorithm configurations through ablation", Journal of Heuristics
/// 22, 2016).
struct AblationChange {
  Configuration configuration;
  std::vector<std::size_t> changed;  ///< parameters: the one that was chosen comes first
};

/// What differs between two configurations, by parameter; two inactive values do not differ.
std::vector<std::size_t> differences(const Configuration& a, const Configuration& b);

/// `current` with the value of `target` in each of the parameters `open`, one at a time, in their
/// order. Parameters that become active take the target's value, those that become inactive lose
/// theirs. Left out are changes that give no configuration of the space, or a forbidden one: they
/// come later, with others.
std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open);

/// What made `after` of `before` on the way to `target`: a change, or all that was left at the end.
std::vector<std::size_t> change_between(const ParameterSpace& space, const Configuration& before,
                                        const Configuration& after, const Configuration& target);

/// The most runs that the way can take.
std::int64_t most_ablation_runs(const Configuration& source, const Configuration& target,
                                std::int64_t pairs);

/// The way from the first of two configurations to the second, as a search whose iterations are:
/// the source, a step each, the target. All are run on the same `ablation_pairs` pairs of instance
/// and seed. A step races the changes that are still open, not elitist and without capping, with
/// the scenario's test (or runs all of them on all pairs), and its elite is the best change by
/// irace's overall ranks, the first of equals. The elites of the last iteration are all on the way,
/// best first: more pairs come before fewer.
///
/// Of the scenario count budget, seed, instances and their order, the test, `bound_max` and whether
/// there is a targetEvaluator. Errors: not two configurations, or two that are the same; a budget
/// below most_ablation_runs.
Expected<std::unique_ptr<Search>> start_ablation(ParameterSpace space, const Scenario& scenario,
                                                 const std::vector<Configuration>& ends);

}  // namespace swarmsmith
