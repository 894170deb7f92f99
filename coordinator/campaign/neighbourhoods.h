#pragma once

#include <memory>

#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/campaign/tree_space.h"
#include "irace_core/search/annealing.h"

namespace swarmsmith {

/// What local search changes in a machine, one of eleven at a time, drawn uniformly among those
/// that can act (docs/methods.md): the start state; a state added or removed; a state's behaviour,
/// or a parameter of it; a transition added or removed; where a transition begins or ends; its
/// condition, or a parameter of it. It starts at one state that stops.
search::Neighbourhood machine_neighbourhood(const std::shared_ptr<const MachineSpace>& space,
                                            const Method& method);

/// The same of trees, one of seven: a subtree added or removed, two swapped, an action or a
/// parameter of it, a condition or a parameter of it. It starts at one subtree that stops.
search::Neighbourhood tree_neighbourhood(const std::shared_ptr<const TreeSpace>& space,
                                         const Method& method);

}  // namespace swarmsmith
