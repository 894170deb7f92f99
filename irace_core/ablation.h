#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "irace_core/experiment.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"

namespace swarmsmith {

/// One step of the way from a configuration to another one (irace's ablation; Fawcett and Hoos,
/// "Analysing differences between algorithm configurations through ablation", Journal of Heuristics
/// 22, 2016).
struct AblationChange {
  Configuration configuration;
  std::vector<std::size_t> changed;  ///< parameters: the one that was chosen comes first
};

/// What differs between two configurations, by parameter; both inactive is no difference.
std::vector<std::size_t> differences(const Configuration& a, const Configuration& b);

/// `current` with the value of `target` in each of the parameters `open`, one at a time, in their
/// order. Parameters that become active take the target's value, those that become inactive lose
/// theirs. Left out are changes that give no configuration of the space, or a forbidden one: they
/// come later, with others.
std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open);

/// How a step finds its best change: all changes are run on all pairs, or they race (the types of
/// R's ablation()).
enum class AblationType { Full, Racing };

/// Makes experiments, and tells what came of each, in their order.
using AblationRuns =
    std::function<Expected<std::vector<Measurement>>(std::span<const Experiment> wanted)>;

/// The position of the best change of a step, by irace's overall ranks; the first of equals;
/// nothing when all were rejected. It is a race that is not elitist, with the tests that the
/// scenario asks for; capping is not used, and bounds are `bound_max`. Experiments count changes
/// and pairs from 1; their instances and seeds are the caller's. Errors: those of `run`, and a
/// target that went over its bound.
Expected<std::optional<std::size_t>> best_change(const Scenario& scenario, AblationType type,
                                                 std::size_t changes, std::int64_t pairs,
                                                 const AblationRuns& run);

/// The position of the best of configurations, by irace's overall ranks. `costs[c]` has a value a
/// pair, NaN where it was not run: more pairs always come before fewer. The first of equals.
std::size_t best_by_ranks(const std::vector<std::vector<double>>& costs, TestType type);

}  // namespace swarmsmith
