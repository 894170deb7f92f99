#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/key.h"

namespace swarmsmith {

/// What an evaluation is a pure function of, besides its campaign's scenario.
struct EvaluationInput {
  std::uint32_t mission = 0;  ///< index into the scenario's missions
  std::uint32_t method = 0;   ///< index into the scenario's methods
  std::uint32_t profile = 0;  ///< 0: the scenario's own; n: its n-th further one
  /// From 1; of a call of a targetEvaluator in testing the negative of it.
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  /// Text of the grammar; for a target the switches and values of its configuration.
  std::string machine{};
  double bound = 0;  ///< most time that a target's run may take, in its unit; 0 for none
  /// Numbers (irace's ids) of the configurations that a targetEvaluator gets; else empty.
  std::vector<std::int64_t> alive{};
};

/// One evaluation that a worker holds a lease of.
struct LeasedTask : EvaluationInput {
  PackedKey key = 0;  ///< names the campaign too
  std::int64_t attempt = 0;
  std::uint64_t signature = 0;  ///< of its lease, for its result
  bool alone = false;           ///< the worker says when it begins, and runs nothing beside it
};

}  // namespace swarmsmith
