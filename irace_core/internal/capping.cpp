#include "irace_core/internal/capping.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "irace_core/internal/means.h"

namespace swarmsmith::irace {
namespace {

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

double summarise(std::vector<double> values, CappingType type) {
  SWARMSMITH_ASSERT(!values.empty(), "there is an elite to compare with");
  switch (type) {
    case CappingType::Median:
      return median(values);
    case CappingType::Mean:
      return mean_of(values);
    case CappingType::Worst:
      return *std::max_element(values.begin(), values.end());
    case CappingType::Best:
      return *std::min_element(values.begin(), values.end());
  }
  SWARMSMITH_ASSERT(false, "all types are handled");
  return 0;
}

double round_up(double value, std::int64_t digits) {
  double scale = 1;
  for (std::int64_t i = 0; i < digits; ++i)
    scale *= 10;
  return std::ceil(value * scale) / scale;
}

double candidate_bound(double elite_time, std::size_t task, double spent, const TimeRules& rules) {
  SWARMSMITH_ASSERT(task >= 1 && elite_time > 0, "an elite took its time for each pair");
  // irace facts, 17: a candidate may spend as much time as the elites on all pairs so far. If it
  // has spent more, its bound is `elite_time`: a bound must be above 0, which would mean no bound.
  const double left = static_cast<double>(task) * elite_time + rules.min_measurable_time - spent;
  const double bound = left > 0 ? left : elite_time;
  return std::min(round_up(bound, rules.bound_digits), rules.bound_max);
}

/// irace facts, 17, `instance`: earlier pairs have no influence on this bound.
double instance_bound(double elite_time, const TimeRules& rules) {
  return std::min(round_up(elite_time + rules.min_measurable_time, rules.bound_digits),
                  rules.bound_max);
}

double capped_cost(double cost, double time, double bound, const TimeRules& rules) {
  // irace facts, 12: the cost of a rejection is not replaced.
  if (std::isinf(cost)) return cost;
  // irace facts, 17 (PARX). Decision 10: only what reaches bound_max is multiplied.
  if (cost >= rules.bound_max) return rules.bound_max * rules.bound_par;
  if (rules.bound_as_timeout && bound < rules.bound_max && time >= bound) return rules.bound_max;
  return cost;
}

std::vector<std::size_t> dominated(std::span<const double> means,
                                   std::span<const std::size_t> elites, CappingType type,
                                   std::int64_t min_survival) {
  // Source: irace facts, 17; the tolerance is irace's.
  constexpr double kTolerance = 1e-5;
  const auto few = static_cast<std::size_t>(min_survival);
  SWARMSMITH_ASSERT(few >= 1,
                    "at least one configuration survives, and the others are compared with it");
  if (means.size() <= few) return {};
  std::vector<double> standard;
  for (const std::size_t i : elites)
    standard.push_back(means[i]);
  // Without a protected elite, the best so far take the place of the elites.
  if (standard.empty()) {
    standard.assign(means.begin(), means.end());
    std::sort(standard.begin(), standard.end());
    standard.resize(few);
  }
  // The elites themselves may be above it, as with the median of several; the race does not drop
  // protected ones.
  const double bound = summarise(std::move(standard), type) + kTolerance;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (means[i] > bound) found.push_back(i);
  }
  return found;
}

}  // namespace swarmsmith::irace
