#pragma once

#include <cstddef>
#include <span>
#include <vector>

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

/// The position of the best of configurations that were all run on the same pairs: by irace's
/// overall ranks. `costs[c]` has a value a pair. The first of equals.
std::size_t best_by_ranks(const std::vector<std::vector<double>>& costs, TestType type);

}  // namespace swarmsmith
