#pragma once

#include <memory>

#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/campaign/tree_space.h"
#include "irace_core/search/annealing.h"

namespace swarmsmith {

/// The changes that local search makes in a machine: one of eleven operators at a time, drawn
/// uniformly among those that are possible (docs/methods.md). They change the start state; add or
/// remove a state; change a state's behaviour, or one of its parameters; add or remove a
/// transition; change where a transition begins or ends; or change its condition, or one of its
/// parameters. The search starts at a machine with a single state that stops.
search::Neighbourhood machine_neighbourhood(const std::shared_ptr<const MachineSpace>& space,
                                            const Method& method);

/// The same for trees, with seven operators: they add or remove a subtree, swap two, or change an
/// action, a parameter of it, a condition or a parameter of it. The search starts at a tree with a
/// single subtree that stops.
search::Neighbourhood tree_neighbourhood(const std::shared_ptr<const TreeSpace>& space,
                                         const Method& method);

}  // namespace swarmsmith
