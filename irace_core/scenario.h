#pragma once

#include <cstdint>
#include <optional>

#include "base/expected.h"

namespace swarmsmith {

/// Which test drops configurations.
enum class TestType {
  FTest,  ///< Friedman with Conover's multiple comparison; Wilcoxon's signed ranks for two
};

/// The options of an iterated race: irace's names and defaults. Zero means "automatic" where a
/// default is said in words.
struct Scenario {
  std::int64_t max_experiments = 0;  ///< the budget: how many experiments may be run
  std::optional<std::int64_t>
      min_experiments;  ///< raises the budget to this or to the least that works
  std::int64_t n_instances = 1;
  std::uint64_t seed = 1;
  bool sample_instances = true;  ///< shuffle the instances

  TestType test_type = TestType::FTest;
  double confidence = 0.95;
  std::int64_t first_test = 5;  ///< pairs before the first test; a multiple of each_test
  std::int64_t each_test = 1;   ///< pairs between tests

  std::int64_t nb_iterations = 0;      ///< 2 + log2(variable parameters), and then no limit
  std::int64_t min_nb_survival = 0;    ///< 2 + log2(variable parameters)
  std::int64_t nb_configurations = 0;  ///< per race; from the budget
  std::int64_t nb_experiments_per_iteration = 0;  ///< an equal share of what is left
  std::int64_t mu = 5;  ///< experiments a new configuration is planned with; raised to first_test

  std::int64_t elitist_new_instances = 1;  ///< pairs that nobody has seen, first in each later race
  std::int64_t elitist_limit =
      2;  ///< a race ends after so many tests in a row that drop nobody; 0 = none
  bool soft_restart = true;
  double soft_restart_threshold = 1e-4;

  std::int64_t max_configurations_per_race = 1024;  ///< not an option of irace, there always 1024
};

/// What is wrong with a scenario by itself; `where` of the error is the option's name.
Expected<void> check(const Scenario& scenario);

}  // namespace swarmsmith
