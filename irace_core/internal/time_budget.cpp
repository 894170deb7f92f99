#include "irace_core/internal/time_budget.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "irace_core/internal/capping.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::irace {

TimeBudget::TimeBudget(const Scenario& scenario, std::int64_t pairs)
    : max_time_(scenario.max_time),
      part_(scenario.budget_estimation),
      least_(scenario.min_measurable_time),
      bound_(scenario.bound_max > 0 ? scenario.bound_max : 1),
      digits_(scenario.bound_digits),
      pairs_(pairs),
      at_once_(std::max<std::int64_t>(1, scenario.parallel / pairs)),
      first_(std::max<std::int64_t>(2, scenario.parallel / pairs)) {
  SWARMSMITH_ASSERT(pairs_ >= 1, "the estimate tries configurations on a pair or more");
}

void TimeBudget::count(double time) {
  SWARMSMITH_ASSERT(time > 0, "a run without its time is an error that was found earlier");
  ++runs_;
  used_ += time;
}

double TimeBudget::estimate_time() const {
  return std::ceil(max_time_ * part_);
}

double TimeBudget::bound_for_estimate() const {
  const auto runs = static_cast<double>(first_ * pairs_);
  if (estimate_time() >= bound_ * runs) return 0;
  return std::max(round_up(estimate_time() / runs, digits_), least_);
}

std::int64_t TimeBudget::first_configurations() const {
  return std::min(kMostForEstimate, first_);
}

std::int64_t TimeBudget::more_configurations(std::int64_t tried) const {
  const double left = estimate_time() - used_;
  if (left <= 0 || tried >= kMostForEstimate) return 0;
  const double affordable = std::floor(left / mean_time() / static_cast<double>(pairs_));
  const auto most = static_cast<double>(std::min(at_once_, kMostForEstimate - tried));
  return static_cast<std::int64_t>(std::min(affordable, most));
}

double TimeBudget::mean_time() const {
  SWARMSMITH_ASSERT(runs_ > 0, "a mean is of one run or more");
  const double mean = used_ / static_cast<double>(runs_);
  return estimating_ ? std::max(round_up(mean, digits_), least_) : mean;
}

void TimeBudget::estimate() {
  const double left = max_time_ - used_;
  // More than can ever be run, and small enough to be an exact integer.
  constexpr double kMost = 1e12;
  remaining_ =
      left <= 0
          ? 0
          : static_cast<std::int64_t>(round_to_digits(std::min(left / mean_time(), kMost), 0));
}

}  // namespace swarmsmith::irace
