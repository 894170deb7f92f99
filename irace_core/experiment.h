#pragma once

#include <cstdint>

namespace swarmsmith {

/// (configuration, instance, seed): the unit of the budget. All ids start at 1; `pair` is the row
/// of the list of (instance, seed) pairs, which all configurations share.
struct Experiment {
  std::int64_t configuration = 0;
  std::int64_t pair = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  double bound = 0;  ///< most time that the run may take; 0 for no bound
  /// Not a run but a call of the targetEvaluator for a run that was made (irace facts, 18.4): not
  /// counted in the budget. The same (configuration, pair) is called again in later races; `task`
  /// tells the calls apart.
  bool is_evaluation = false;
  std::int64_t task = 0;  ///< of a call of the targetEvaluator: counts the design's tasks from 1

  friend bool operator==(const Experiment&, const Experiment&) = default;
};

/// What came of an experiment. Of a run before a targetEvaluator the cost is not looked at, of a
/// call of it the time is not.
struct Measurement {
  double cost = 0;  ///< smaller is better; infinite: rejected
  double time = 0;  ///< above 0 where the target says it; needed with max_time
};

}  // namespace swarmsmith
