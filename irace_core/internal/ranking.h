#pragma once

#include <vector>

#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// Overall ranks of configurations that were not all tried on the same pairs (irace facts, 11):
/// more pairs always come before fewer. `costs[c]` holds one value per row (pair) for configuration
/// c, NaN where it was not tried; all have the same number of rows. Configurations with the same
/// number of pairs form a group, and within a group only the rows count on which all its
/// configurations were tried: for the F-test the rank is the sum of the average ranks in these
/// rows, for t-tests the average rank of the mean cost. The ranks of a group are increased by the
/// largest rank of the group before.
std::vector<double> overall_ranks(const std::vector<std::vector<double>>& costs, TestType type);

}  // namespace swarmsmith::irace
