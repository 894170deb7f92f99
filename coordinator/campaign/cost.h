#pragma once

namespace swarmsmith {

/// The one place where the sign turns. People, stores and workers know scores (larger is better);
/// irace_core minimises costs.
constexpr double to_cost(double score) { return -score; }
constexpr double to_score(double cost) { return -cost; }

}  // namespace swarmsmith
