#pragma once

#include <cstdint>

#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::colony {

/// A tuning benchmark with a closed formula, similar to an ant colony algorithm: ten parameters of
/// all types, two levels of conditions, 50 instances of very different scale, and noise that is a
/// hash of all inputs. R's irace was run on it (benchmarks/data/irace_colony_r.csv).
///
/// With a and b the fractional parts of multiples of two irrational numbers (the instance), A the
/// position of `algo` and L the number of `ls`, the relative loss is
///
///     g = (0.30, 0.12, 0.08, 0.05)[A] + (0.40, 0.15, 0.05, 0)[L]
///       + 1.2 ((alpha - 1 - 0.6 (a - 0.5)) / 5)^2
///       + 0.8 ((beta - 3 - 4 (b - 0.5)) / 10)^2 + 0.02 (1 - cos(2 pi beta))
///       + 0.6 (rho - (0.10, 0.30, 0.50, 0.20)[A] - 0.1 (a - 0.5))^2
///       + 0.5 ((ln ants - ln(L = 0 ? 200 : 25)) / ln 100)^2
///       + (algo = d ? 0.5 (q0 - 0.9 + 0.2 a)^2 : 0)
///       + (algo = c ? 0.3 ((ln rank - ln(6 + 4 b)) / ln 100)^2 : 0)
///       + (L > 0 ? 0.4 ((nn - 20 - 10 (a - 0.5)) / 45)^2 + (dlb = 0 ? 0.03 (1 + b) : 0) : 0)

inline constexpr std::int64_t kInstances = 50;

/// The ten parameters, with four decimals.
ParameterSpace space();

/// The loss without noise on instance 1, 2, ...
double loss(const Configuration& configuration, std::int64_t instance);

/// The cost that a target would print: 10^(1 + 2 a) (1 + g) (1 + 0.05 z), where z has mean 0 and
/// variance 1.
double cost(const Configuration& configuration, std::int64_t instance, std::int64_t seed);

/// The true cost of a configuration: the mean loss over instances 1 to 1000.
double true_cost(const Configuration& configuration);

}  // namespace swarmsmith::colony
