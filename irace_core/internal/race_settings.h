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

/// What one race is asked to do.
struct RaceSettings {
  bool elitist = true;
  TestType test_type = TestType::FTest;
  std::int64_t first_test = 5;           ///< T_f, in pairs
  std::int64_t pairs_between_tests = 1;  ///< T_e
  std::int64_t block_size = 1;           ///< pairs in a block; capping drops after whole blocks
  std::int64_t elitist_limit = 2;
  double confidence = 0.95;
  std::int64_t min_survival = 1;
  std::int64_t max_experiments = 0;  ///< looked at where a race may stop (irace facts, 9.3.2)
  /// The rest of the design's budget: no task begins that would need more.
  std::int64_t experiments_left = std::numeric_limits<std::int64_t>::max();
  /// Pairs in the order of the tasks: `new_pairs` that none has seen, `past_pairs` that some
  /// elites have seen, then unused ones.
  std::vector<std::int64_t> pairs;
  std::int64_t new_pairs = 0;
  std::int64_t past_pairs = 0;
  /// One task at a time is asked for.
  bool one_task_at_a_time = false;
  /// The costs come from calls of the targetEvaluator, for all who are alive, after each task's
  /// runs.
  bool target_evaluator = false;

  /// Bounds on times and capping (irace facts, 17); without `capping` every run is bounded by
  /// `bound_max`, if that is not 0, and costs are taken as they come.
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

/// A configuration that takes part. `past` holds what an elite cost on the past pairs, in the order
/// of the tasks, NaN where it was not tried; empty for a new one.
struct Contestant {
  std::int64_t id;
  std::vector<double> past;
  std::vector<double> past_times;  ///< as `past`; needed only for capping
};

/// One experiment that the race asks for.
struct RaceRun {
  std::size_t task;            ///< 0-based
  std::size_t column;          ///< position among the contestants
  double bound = 0;            ///< most time of the run; 0 for none
  bool is_evaluation = false;  ///< a call of the targetEvaluator after the runs of the task

  friend bool operator==(const RaceRun&, const RaceRun&) = default;
};

/// Whether a column is among `sorted` (ascending).
inline bool contains(std::span<const std::size_t> sorted, std::size_t column) {
  return std::binary_search(sorted.begin(), sorted.end(), column);
}

}  // namespace swarmsmith::irace
