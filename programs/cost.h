#pragma once

namespace swarmsmith {

/// The only place where the sign changes. People, stores and workers use scores (larger is better);
/// irace_core minimises costs. Zero is always +0, because a store does not keep the sign of zero.
constexpr double to_cost(double score) {
  return 0.0 - score;
}
constexpr double to_score(double cost) {
  return 0.0 - cost;
}

/// Limit of a finite cost or score, so that sums, and therefore means, stay finite.
constexpr double kLargestCost = 1e300;
constexpr bool is_too_large(double number) {
  return number < -kLargestCost || number > kLargestCost;
}

}  // namespace swarmsmith
