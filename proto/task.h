#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/key.h"

namespace swarmsmith {

/// The inputs that determine an evaluation, together with its campaign's scenario.
struct EvaluationInput {
  std::uint32_t mission = 0;  ///< index into the scenario's missions
  std::uint32_t method = 0;   ///< index into the scenario's methods
  std::uint32_t profile = 0;  ///< 0: the scenario's own profile; n: its n-th further one
  /// From 1; negative for a call of a targetEvaluator in testing.
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  /// A machine as text of the grammar; for a target, the switches and values of its configuration.
  std::string machine{};
  double bound =
      0;  ///< longest time that a target's run may take, in the target's unit; 0: no limit
  /// Numbers (irace's ids) of the configurations that a targetEvaluator gets; else empty.
  std::vector<std::int64_t> alive{};
};

/// One evaluation for which a worker has a lease.
struct LeasedTask : EvaluationInput {
  PackedKey key = 0;  ///< also identifies the campaign
  std::int64_t attempt = 0;
  std::uint64_t signature = 0;  ///< of the lease; the result needs it
  bool alone =
      false;  ///< the worker reports when it begins, and runs nothing else at the same time
};

}  // namespace swarmsmith
