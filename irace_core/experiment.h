#pragma once

#include <cstdint>

namespace swarmsmith {

/// One run of the target, (configuration, instance, seed): the unit of the budget. All ids start at
/// 1; `pair` is the row in the list of (instance, seed) pairs, which all configurations share.
struct Experiment {
  std::int64_t configuration = 0;
  std::int64_t pair = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  double bound = 0;  ///< maximum time that the run may take; 0 for no bound
  /// True for a call of the targetEvaluator for a run that was made earlier (irace facts, 18.4).
  /// Such calls do not count in the budget. Later races call it again for the same (configuration,
  /// pair); `task` distinguishes these calls.
  bool is_evaluation = false;
  /// Number of the task in the design, from 1; only for calls of the targetEvaluator.
  std::int64_t task = 0;

  friend bool operator==(const Experiment&, const Experiment&) = default;
};

/// The result of an experiment. With a targetEvaluator the cost of a run is ignored, and so is the
/// time of a call of the targetEvaluator.
struct Measurement {
  double cost = 0;  ///< smaller is better; infinite means rejected
  double time = 0;  ///< above 0 if the target reports it; required with max_time
};

}  // namespace swarmsmith
