#pragma once

#include <cstdint>
#include <optional>

#include "base/expected.h"

namespace swarmsmith {

/// The test that drops configurations.
enum class TestType {
  /// Friedman with Conover's multiple comparison; Wilcoxon's signed ranks for two configurations
  FTest,
  TTest,  ///< paired t-tests against the best mean, p-values not adjusted
  TTestBonferroni,
  TTestHolm,
};

/// The statistic of the elites' times (or costs) that bounds the other configurations, when
/// capping.
enum class CappingType { Median, Mean, Worst, Best };

/// Whether a bound limits the total of a configuration's runs in a race, or the run on one pair.
enum class BoundType { Candidate, Instance };

/// How a step of an ablation finds its best change: all changes are run on all pairs, or they are
/// raced (the types of R's ablation()).
enum class AblationType { Full, Racing };

/// The options of an iterated race, with irace's names and defaults (irace facts, 22). If a comment
/// describes the default in words, zero means "automatic".
struct Scenario {
  std::int64_t max_experiments = 0;  ///< the budget: maximum number of experiments
  /// If set, the budget is this number, or the smallest that works if that is larger, and
  /// max_experiments is ignored.
  std::optional<std::int64_t> min_experiments;
  std::int64_t n_instances = 1;
  std::uint64_t seed = 1;
  bool sample_instances = true;  ///< shuffle the instances
  bool deterministic = false;    ///< each instance is used at most once

  std::optional<TestType> test_type;  ///< default: FTest, or TTest when capping
  double confidence = 0.95;
  std::int64_t first_test = 5;  ///< blocks before the first test; a multiple of each_test
  std::int64_t each_test = 1;   ///< blocks between tests
  std::int64_t block_size = 1;  ///< pairs in a block; divides n_instances

  /// default: 2 + log2(variable parameters), and then it is not a limit
  std::int64_t nb_iterations = 0;
  std::int64_t min_nb_survival = 0;    ///< default: 2 + log2(variable parameters)
  std::int64_t nb_configurations = 0;  ///< per race; default: from the budget
  /// default: an equal share of the remaining budget
  std::int64_t nb_experiments_per_iteration = 0;
  std::int64_t mu = 5;  ///< planned experiments per new configuration; raised to first_test

  bool elitist = true;
  /// Number of blocks of new instances, which come first in each later race.
  std::int64_t elitist_new_instances = 1;
  /// A race ends after this many tests in a row without a drop; 0 = no limit.
  std::int64_t elitist_limit = 2;
  bool soft_restart = true;
  double soft_restart_threshold = 1e-4;
  /// a last race with the remaining budget; elitist only, not with max_time
  bool postselection = true;

  /// The budget as total time of the target's runs, instead of max_experiments; 0 = none.
  double max_time = 0;
  double budget_estimation = 0.05;    ///< fraction of max_time for the first estimate
  double min_measurable_time = 0.01;  ///< shorter times are raised to this
  /// Number of parallel runs that the first estimate assumes; nothing else here depends on it.
  std::int64_t parallel = 0;

  /// Stop runs that are slower than the elites; default: yes with max_time and bound_max.
  std::optional<bool> capping;
  bool capping_after_first_test = false;
  CappingType capping_type = CappingType::Median;
  BoundType bound_type = BoundType::Candidate;
  double bound_max = 0;           ///< maximum time of a run; 0 = no bounds
  std::int64_t bound_digits = 0;  ///< decimals to which bounds are rounded
  double bound_par = 1;           ///< a run that reaches bound_max costs this many times bound_max
  bool bound_as_timeout = true;   ///< a run that reaches a smaller bound costs bound_max

  /// Costs come from a second call for each run, after all runs of a task (irace's
  /// targetEvaluator).
  bool target_evaluator = false;
  /// Asks for one task at a time, as irace does, instead of all tasks up to the next test, so that
  /// no run is made in vain after a rejection.
  bool one_task_at_a_time = false;

  /// Instead of a search, an ablation: the path from the first given configuration to the second
  /// one (irace_core/ablation.h), on `ablation_pairs` pairs.
  std::optional<AblationType> ablation;
  std::int64_t ablation_pairs = 1;

  /// Not an option of irace, where it is always 1024.
  std::int64_t max_configurations_per_race = 1024;
};

/// Checks a scenario without its parameter space; `where` of the error is the option's name.
Expected<void> check(const Scenario& scenario);

/// Whether runs are capped by adaptive bounds (irace facts, 17).
bool uses_capping(const Scenario& scenario);
/// The cost that a race with capping uses for a run with a bound, where `bound_max` is the maximum
/// time of a run. A run whose cost reaches bound_max costs bound_par times bound_max. With
/// bound_as_timeout, a run whose time reaches a smaller bound costs bound_max. A rejection stays a
/// rejection.
double capped_cost(const Scenario& scenario, double bound_max, double cost, double time,
                   double bound);
/// The test that drops configurations.
TestType test_type_of(const Scenario& scenario);

}  // namespace swarmsmith
