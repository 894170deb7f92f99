#pragma once

#include <vector>

#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// Overall ranks of configurations that were not all tried on the same pairs (irace facts, 11):
/// more pairs always come before fewer. `costs[c]` holds one value a row (pair) for configuration
/// c, NaN where it was not tried; all have the same rows. Within a group of the same number of
/// pairs only the rows count that the whole group has: for the F-test the rank is the sum of the
/// average ranks in them, for t-tests the average rank of the mean cost. The ranks of a group are
/// shifted by the largest one of the group before.
std::vector<double> overall_ranks(const std::vector<std::vector<double>>& costs, TestType type);

}  // namespace swarmsmith::irace
