#pragma once

#include <cstdint>
#include <optional>

#include "base/expected.h"

namespace swarmsmith {

/// Which test drops configurations.
enum class TestType {
  FTest,  ///< Friedman with Conover's multiple comparison; Wilcoxon's signed ranks for two
  TTest,  ///< paired t-tests against the best mean, p-values as they are
  TTestBonferroni,
  TTestHolm,
};

/// What of the elites' times (or costs) bounds the others, when capping.
enum class CappingType { Median, Mean, Worst, Best };

/// Whether a bound holds for all that a configuration did in a race, or for one pair.
enum class BoundType { Candidate, Instance };

/// How a step of an ablation finds its best change: all changes are run on all pairs, or they race
/// (the types of R's ablation()).
enum class AblationType { Full, Racing };

/// The options of an iterated race: irace's names and defaults (irace facts, 22). Zero means
/// "automatic" where a default is given in words.
struct Scenario {
  std::int64_t max_experiments = 0;  ///< the budget: how many experiments may be run
  std::optional<std::int64_t>
      min_experiments;  ///< raises the budget to this or to the least that works
  std::int64_t n_instances = 1;
  std::uint64_t seed = 1;
  bool sample_instances = true;  ///< shuffle the instances
  bool deterministic = false;    ///< each instance is used once at most

  std::optional<TestType> test_type;  ///< FTest, or TTest when capping
  double confidence = 0.95;
  std::int64_t first_test = 5;  ///< blocks before the first test; a multiple of each_test
  std::int64_t each_test = 1;   ///< blocks between tests
  std::int64_t block_size = 1;  ///< pairs in a block; divides n_instances

  std::int64_t nb_iterations = 0;      ///< 2 + log2(variable parameters), and then no limit
  std::int64_t min_nb_survival = 0;    ///< 2 + log2(variable parameters)
  std::int64_t nb_configurations = 0;  ///< per race; from the budget
  std::int64_t nb_experiments_per_iteration = 0;  ///< an equal share of the rest
  std::int64_t mu = 5;  ///< experiments a new configuration is planned with; raised to first_test

  bool elitist = true;
  /// Blocks of new instances, first in each later race.
  std::int64_t elitist_new_instances = 1;
  std::int64_t elitist_limit =
      2;  ///< a race ends after so many tests in a row without a drop; 0 = none
  bool soft_restart = true;
  double soft_restart_threshold = 1e-4;
  bool postselection = true;  ///< a last race with the rest; elitist only, not with max_time

  /// The budget as the sum of the targets' times, in place of max_experiments; 0 = none.
  double max_time = 0;
  double budget_estimation = 0.05;    ///< part of max_time for the first estimate
  double min_measurable_time = 0.01;  ///< shorter times are raised to this
  /// Runs at a time that the first estimate counts on; nothing else here depends on it.
  std::int64_t parallel = 0;

  /// Stop runs that are slower than the elites; automatic: with max_time and bound_max.
  std::optional<bool> capping;
  bool capping_after_first_test = false;
  CappingType capping_type = CappingType::Median;
  BoundType bound_type = BoundType::Candidate;
  double bound_max = 0;           ///< most time of a run; 0 = no bounds
  std::int64_t bound_digits = 0;  ///< decimals of bounds
  double bound_par = 1;           ///< runs that reach bound_max cost so many times bound_max
  bool bound_as_timeout = true;   ///< runs that reach a smaller bound cost bound_max

  /// Costs come from a second call, after all runs of a task (irace's targetEvaluator).
  bool target_evaluator = false;
  /// Asks for one task at a time, as irace does, and not for all up to the next test: nothing that
  /// a rejection makes void is run.
  bool one_task_at_a_time = false;

  /// In place of a search: the way from the first given configuration to the second one
  /// (irace_core/ablation.h), on so many pairs.
  std::optional<AblationType> ablation;
  std::int64_t ablation_pairs = 1;

  std::int64_t max_configurations_per_race = 1024;  ///< not an option of irace, there always 1024
};

/// The fault of a scenario by itself, if any; `where` of the error is the option's name.
Expected<void> check(const Scenario& scenario);

/// Whether bounds are adapted (irace facts, 17).
bool uses_capping(const Scenario& scenario);
/// What a run with a bound costs a race that caps, whose runs may take `bound_max` at most: one
/// that costs as much costs bound_par times that, and one that took as long as a smaller bound
/// costs bound_max, if bound_as_timeout. A rejection stays one.
double capped_cost(const Scenario& scenario, double bound_max, double cost, double time,
                   double bound);
/// The test that drops configurations.
TestType test_type_of(const Scenario& scenario);

}  // namespace swarmsmith
