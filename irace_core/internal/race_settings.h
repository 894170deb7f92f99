#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "irace_core/internal/capping.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The settings of one race.
struct RaceSettings {
  bool elitist = true;
  TestType test_type = TestType::FTest;
  std::int64_t first_test = 5;           ///< T_f, in pairs
  std::int64_t pairs_between_tests = 1;  ///< T_e
  /// Pairs in a block; capping drops configurations only after whole blocks.
  std::int64_t block_size = 1;
  std::int64_t elitist_limit = 2;
  double confidence = 0.95;
  std::int64_t min_survival = 1;
  std::int64_t max_experiments = 0;  ///< limit for the rules that stop a race (irace facts, 9.3.2)
  /// The remaining budget of the design: a task that needs more does not begin.
  std::int64_t experiments_left = std::numeric_limits<std::int64_t>::max();
  /// Pairs in the order of the tasks: `new_pairs` that no configuration has been run on,
  /// `past_pairs` that some elites have been run on, then unused ones.
  std::vector<std::int64_t> pairs;
  std::int64_t new_pairs = 0;
  std::int64_t past_pairs = 0;
  /// Asks for one task at a time.
  bool one_task_at_a_time = false;
  /// The costs come from calls of the targetEvaluator, for all alive configurations, after the runs
  /// of each task.
  bool target_evaluator = false;

  /// Bounds on times, and capping (irace facts, 17). Without `capping`, every run is bounded by
  /// `bound_max`, if that is not 0, and costs are not changed.
  bool capping = false;
  bool capping_after_first_test = false;
  CappingType capping_type = CappingType::Median;
  BoundType bound_type = BoundType::Candidate;
  double bound_max = 0;
  std::int64_t bound_digits = 0;
  double bound_par = 1;
  bool bound_as_timeout = true;
  double min_measurable_time = 0.01;

  TimeRules time_rules() const {
    return {bound_max, bound_digits, bound_par, bound_as_timeout, min_measurable_time};
  }
};

/// A configuration that takes part. `past` holds an elite's costs on the past pairs, in the order
/// of the tasks, NaN where it was not run; empty for a new configuration.
struct Contestant {
  std::int64_t id;
  std::vector<double> past;
  std::vector<double> past_times;  ///< as `past`; needed only for capping
};

/// One experiment that the race asks for.
struct RaceRun {
  std::size_t task;    ///< 0-based
  std::size_t column;  ///< position among the contestants
  double bound = 0;    ///< maximum time of the run; 0 for none
  /// Whether this is a call of the targetEvaluator after the runs of the task.
  bool is_evaluation = false;

  friend bool operator==(const RaceRun&, const RaceRun&) = default;
};

/// Whether `sorted` (ascending) contains a column.
inline bool contains(std::span<const std::size_t> sorted, std::size_t column) {
  return std::binary_search(sorted.begin(), sorted.end(), column);
}

}  // namespace swarmsmith::irace
