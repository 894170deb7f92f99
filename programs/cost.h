#pragma once

namespace swarmsmith {

/// The one place where the sign turns. People, stores and workers know scores (larger is better);
/// irace_core minimises costs. Zero is always +0, whatever its sign was: a store does not keep it.
constexpr double to_cost(double score) {
  return 0.0 - score;
}
constexpr double to_score(double cost) {
  return 0.0 - cost;
}

/// Of a finite cost or score: sums of them must be finite, and means what they say.
constexpr double kLargestCost = 1e300;
constexpr bool is_too_large(double number) {
  return number < -kLargestCost || number > kLargestCost;
}

}  // namespace swarmsmith
