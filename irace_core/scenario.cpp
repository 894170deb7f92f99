#include "irace_core/scenario.h"

#include <string>

namespace swarmsmith {
namespace {

struct Limit {
  const char* option;
  std::int64_t value;
  std::int64_t least;
};

}  // namespace

Expected<void> check(const Scenario& scenario) {
  const Limit limits[] = {
      {"max_experiments", scenario.max_experiments, 1},
      {"min_experiments", scenario.min_experiments.value_or(0), 0},
      {"n_instances", scenario.n_instances, 1},
      {"first_test", scenario.first_test, 1},
      {"each_test", scenario.each_test, 1},
      {"nb_iterations", scenario.nb_iterations, 0},
      {"min_nb_survival", scenario.min_nb_survival, 0},
      {"nb_configurations", scenario.nb_configurations, 0},
      {"nb_experiments_per_iteration", scenario.nb_experiments_per_iteration, 0},
      {"mu", scenario.mu, 1},
      {"elitist_new_instances", scenario.elitist_new_instances, 0},
      {"elitist_limit", scenario.elitist_limit, 0},
      {"max_configurations_per_race", scenario.max_configurations_per_race, 2},
  };
  for (const Limit& limit : limits) {
    if (limit.value >= limit.least) continue;
    return bad_input("must be " + std::to_string(limit.least) + " or more, and is " +
                         std::to_string(limit.value),
                     limit.option);
  }
  if (scenario.first_test % scenario.each_test != 0) {
    return bad_input("must be a multiple of each_test", "first_test");
  }
  if (!(scenario.confidence > 0 && scenario.confidence < 1)) {
    return bad_input("must lie between 0 and 1", "confidence");
  }
  if (!(scenario.soft_restart_threshold >= 0 && scenario.soft_restart_threshold <= 1)) {
    return bad_input("must lie in 0..1", "soft_restart_threshold");
  }
  return {};
}

bool uses_capping(const Scenario& scenario) {
  return scenario.capping.value_or(scenario.elitist && scenario.max_time > 0 &&
                                   scenario.bound_max > 0);
}

TestType test_type_of(const Scenario& scenario) {
  return scenario.test_type.value_or(uses_capping(scenario) ? TestType::TTest : TestType::FTest);
}

}  // namespace swarmsmith
