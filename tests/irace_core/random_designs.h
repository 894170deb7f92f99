#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "tests/irace_core/costs.h"
#include "tests/irace_core/spaces.h"

namespace swarmsmith::testing {

/// Options that can be mixed freely; most mixes are nonsense.
inline Scenario random_scenario(Rng& rng) {
  Scenario s;
  s.seed = rng.next();
  s.block_size = rng.bernoulli(0.3) ? rng.uniform_int(2, 3) : 1;
  s.n_instances = s.block_size * rng.uniform_int(1, 8);
  s.each_test = rng.bernoulli(0.3) ? 2 : 1;
  s.first_test = s.each_test * rng.uniform_int(1, 4);
  s.sample_instances = rng.bernoulli(0.7);
  s.elitist = rng.bernoulli(0.7);
  s.deterministic = rng.bernoulli(0.3);
  s.elitist_new_instances = rng.uniform_int(0, 2);
  s.elitist_limit = rng.uniform_int(0, 3);
  s.soft_restart = rng.bernoulli(0.7);
  s.soft_restart_threshold = rng.bernoulli(0.5) ? 1e-4 : 0.1;
  s.postselection = rng.bernoulli(0.7);
  s.one_task_at_a_time = rng.bernoulli(0.3);
  s.target_evaluator = rng.bernoulli(0.15);
  s.test_type = static_cast<TestType>(rng.below(4));
  s.nb_iterations = rng.bernoulli(0.2) ? rng.uniform_int(1, 5) : 0;
  s.min_nb_survival = rng.bernoulli(0.2) ? rng.uniform_int(1, 5) : 0;
  s.nb_configurations = rng.bernoulli(0.2) ? rng.uniform_int(4, 25) : 0;
  s.nb_experiments_per_iteration = rng.bernoulli(0.15) ? rng.uniform_int(20, 300) : 0;
  s.mu = rng.bernoulli(0.2) ? s.block_size * rng.uniform_int(1, 10) : 5;
  if (rng.bernoulli(0.3)) {
    s.elitist = true;
    s.max_time = rng.uniform(20, 900);
    s.parallel = rng.uniform_int(0, 40);
    s.bound_max = rng.bernoulli(0.5) ? rng.uniform(1, 10) : 0;
    s.bound_digits = rng.uniform_int(0, 2);
  } else {
    s.max_experiments = rng.uniform_int(20, 700);
  }
  return s;
}

inline ParameterSpace random_space(Rng& rng) {
  std::vector<Parameter> parameters{make_categorical("kind", {"a", "b", "c"}),
                                    make_real("x", 0, 10)};
  if (rng.bernoulli(0.7)) parameters.push_back(make_integer("n", 1, 40, rng.bernoulli(0.5)));
  if (rng.bernoulli(0.7)) parameters.push_back(make_ordinal("size", {"s", "m", "l"}));
  if (rng.bernoulli(0.5)) {
    parameters.push_back(active_when(make_real("y", -1, 1), equals("kind", "b")));
  }
  std::vector<Expression> forbidden;
  if (rng.bernoulli(0.4)) {
    forbidden.push_back(
        call(Operation::And, equals("kind", "c"), call(Operation::Less, name("x"), number(4))));
  }
  return space_of(std::move(parameters), std::move(forbidden));
}

inline Measurement answer(const Configuration& configuration, const Experiment& experiment,
                          double rejects) {
  Rng noise(configuration.digest() * 3 + static_cast<std::uint64_t>(experiment.instance));
  double time = 0.2 + 3 * noise.uniform();
  if (experiment.bound > 0) time = std::min(time, experiment.bound);
  if (noise.bernoulli(rejects)) return {std::numeric_limits<double>::infinity(), time};
  return {synthetic_cost(configuration, experiment), time};
}

}  // namespace swarmsmith::testing
