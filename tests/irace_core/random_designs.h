#pragma once

#include <algorithm>
#include <cmath>
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
    s.budget_estimation = rng.uniform(0.02, 0.2);
  } else {
    s.max_experiments = rng.uniform_int(20, 700);
    if (rng.bernoulli(0.15)) {
      s.elitist = true;
      s.capping = true;
      s.bound_max = rng.uniform(1, 5);
    }
  }
  s.capping_type = static_cast<CappingType>(rng.below(4));
  s.capping_after_first_test = rng.bernoulli(0.3);
  s.bound_type = rng.bernoulli(0.5) ? BoundType::Instance : BoundType::Candidate;
  s.bound_par = rng.bernoulli(0.3) ? 10 : 1;
  s.bound_as_timeout = rng.bernoulli(0.7);
  s.min_measurable_time = rng.bernoulli(0.3) ? 0.5 : 0.01;
  s.confidence = rng.bernoulli(0.3) ? rng.uniform(0.5, 0.99) : 0.95;
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
  if (rng.bernoulli(0.3)) parameters.push_back(make_categorical("only", {"one"}));
  if (rng.bernoulli(0.3)) parameters.push_back(make_real("rate", 0.001, 10, true));
  if (rng.bernoulli(0.3)) {  // a domain that depends on another value
    const Expression upper = call(Operation::Add, name("x"), number(rng.bernoulli(0.2) ? 0 : 3));
    parameters.push_back({"m", "", Integer{-2.0, call(Operation::Ceiling, upper)}, {}});
    parameters.push_back({"z", "", Real{-1.0, upper}, equals("kind", "a")});
  }
  std::vector<Expression> forbidden;
  if (rng.bernoulli(0.4)) {
    forbidden.push_back(
        call(Operation::And, equals("kind", "c"), call(Operation::Less, name("x"), number(4))));
  }
  return space_of(std::move(parameters), std::move(forbidden));
}

struct Design {
  ParameterSpace space;
  Scenario scenario;
  double rejects = 0;  ///< share of the runs that reject
  std::vector<Configuration> initial;
  Repair repair;
};

inline Design random_design(Rng& rng) {
  Design design{.space = random_space(rng), .scenario = random_scenario(rng)};
  design.rejects = rng.bernoulli(0.3) ? rng.uniform(0, 0.3) : 0;
  const std::int64_t given = rng.bernoulli(0.3) ? rng.uniform_int(1, 12) : 0;
  for (std::int64_t i = 0; i < given; ++i) {
    if (auto drawn = sample_uniform(design.space, rng)) design.initial.push_back(*drawn);
  }
  if (rng.bernoulli(0.15)) {  // even numbers for x
    design.repair = [space = design.space](const Configuration& sampled) {
      Configuration changed = sampled;
      changed.set(1, std::floor(sampled[1] / 2) * 2);
      return Expected<Configuration>(space.check(changed) ? changed : sampled);
    };
  }
  return design;
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
