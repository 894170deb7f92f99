#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "irace_core/experiment.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The rules about time for all runs of a race (irace facts, 17). The members are options of the
/// same names.
struct TimeRules {
  double bound_max = 0;
  std::int64_t bound_digits = 0;
  double bound_par = 1;
  bool bound_as_timeout = true;
  double min_measurable_time = 0.01;
};

/// Summarises the elites' times or costs as one number; `values` is not empty.
double summarise(std::vector<double> values, CappingType type);

/// The smallest number with `digits` decimals that is not below `value`.
double round_up(double value, std::int64_t digits);

/// The bound of a candidate's run on the `task`th pair of a race (from 1). `elite_time` is the
/// elites' mean time over the pairs up to this one (at most bound_max), `spent` the time that the
/// candidate has spent on the pairs before.
double candidate_bound(double elite_time, std::size_t task, double spent, const TimeRules& rules);

/// The bound of a run on a pair on which the elites' time is `elite_time`.
double instance_bound(double elite_time, const TimeRules& rules);

/// The cost of a run in a race with capping: bound_par times bound_max if its cost reaches
/// bound_max; with bound_as_timeout, bound_max if its time reaches a smaller bound. A rejection
/// stays a rejection.
double capped_cost(double cost, double time, double bound, const TimeRules& rules);

/// The positions of the configurations whose mean cost is above the limit given by the elites'
/// means. `means` are the means of all alive configurations, `elites` the positions of the elites
/// among them. Without elites, the best `min_survival` configurations take their place. If at most
/// that many are alive, none is dominated.
std::vector<std::size_t> dominated(std::span<const double> means,
                                   std::span<const std::size_t> elites, CappingType type,
                                   std::int64_t min_survival);

}  // namespace swarmsmith::irace
