#pragma once

#include <vector>

namespace swarmsmith::irace {

/// Overall ranks of configurations that were not all tried on the same pairs (irace facts, 11):
/// more pairs always come before fewer. `costs[c]` holds one value a row (pair) for configuration
/// c, NaN where it was not tried; all have the same rows. Within a group of the same number of
/// pairs the rank is the sum of average ranks over the rows that the whole group has; the ranks of
/// a group are shifted by the largest one of the group before.
std::vector<double> overall_ranks(const std::vector<std::vector<double>>& costs);

}  // namespace swarmsmith::irace
