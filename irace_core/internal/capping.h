#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "irace_core/experiment.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// What all runs of a race have in common about time (irace facts, 17); options of the same names.
struct TimeRules {
  double bound_max = 0;
  std::int64_t bound_digits = 0;
  double bound_par = 1;
  bool bound_as_timeout = true;
  double min_measurable_time = 0.01;
};

/// The elites' times or costs as one number; `values` is not empty.
double summarise(std::vector<double> values, CappingType type);

/// The smallest number with `digits` decimals that is not below `value`.
double round_up(double value, std::int64_t digits);

/// The bound of a run on the `task`th pair of a race (from 1), when the elites' mean time over
/// these pairs is `elite_time` (at most bound_max) and the candidate has spent `spent` on those
/// before.
double candidate_bound(double elite_time, std::size_t task, double spent, const TimeRules& rules);

/// The bound of a run when the elites' time on the same pair is `elite_time`.
double instance_bound(double elite_time, const TimeRules& rules);

/// What a run under capping costs: one that reaches bound_max costs bound_par times that, one that
/// reaches a smaller bound costs bound_max, if bound_as_timeout. A rejection stays one.
double capped_cost(double cost, double time, double bound, const TimeRules& rules);

/// The positions whose mean cost is above what the elites' means allow. `means` are those of all
/// who are alive, `elites` positions among them. Without elites the best `min_survival` stand in
/// for them; none is dominated where so few are alive.
std::vector<std::size_t> dominated(std::span<const double> means,
                                   std::span<const std::size_t> elites, CappingType type,
                                   std::int64_t min_survival);

}  // namespace swarmsmith::irace
