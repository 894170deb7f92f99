#pragma once

#include <cstdint>

#include "irace_core/race_event.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The largest number of configurations in the estimate; a race of irace has no more.
inline constexpr std::int64_t kMostForEstimate = 1024;

/// The number of experiments that max_time allows (irace facts, 16): it is computed from the times
/// of all experiments so far; before the first race, a fraction of max_time is used for an
/// estimate.
class TimeBudget {
 public:
  /// `pairs`: T_f, the number of pairs on which configurations are tried for the estimate.
  TimeBudget(const Scenario& scenario, std::int64_t pairs);

  /// Counts an experiment that took this time.
  void count(double time);
  std::int64_t runs() const { return runs_; }
  double used() const { return used_; }

  /// The bound with which the first configurations fit into the estimate's time, at least
  /// min_measurable_time; 0 when they fit with bound_max (1 if it is not set).
  double bound_for_estimate() const;
  /// The number of configurations with which the estimate begins.
  std::int64_t first_configurations() const;
  /// The number of further configurations that the estimate tries, after `tried` so far; 0 at its
  /// end.
  std::int64_t more_configurations(std::int64_t tried) const;
  /// From now on mean times are not rounded.
  void end_estimate() { estimating_ = false; }

  /// The mean time of an experiment; during the estimate rounded up to bound_digits.
  double mean_time() const;
  /// The number of experiments that fit in the remaining time; 0 when it is used up.
  std::int64_t remaining() const { return remaining_; }
  /// Computes remaining() from the mean time so far.
  void estimate();

 private:
  double estimate_time() const;

  double max_time_;
  double part_;
  double least_;
  double bound_;
  std::int64_t digits_;
  std::int64_t pairs_;
  std::int64_t at_once_;  ///< configurations that run in parallel on all pairs; 1 or more
  std::int64_t first_;
  bool estimating_ = true;
  std::int64_t runs_ = 0;
  double used_ = 0;
  std::int64_t remaining_ = 0;
};

}  // namespace swarmsmith::irace
