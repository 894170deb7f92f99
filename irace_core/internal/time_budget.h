#pragma once

#include <cstdint>

#include "irace_core/race_event.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The estimate tries no more configurations than a race of irace holds.
inline constexpr std::int64_t kMostForEstimate = 1024;

/// How many experiments max_time is good for (irace facts, 16): the sum of all times so far, and
/// before the first race an estimate from a part of the time.
class TimeBudget {
 public:
  /// `pairs`: T_f, on which configurations are tried for the estimate.
  TimeBudget(const Scenario& scenario, std::int64_t pairs);

  /// An experiment took so long.
  void count(double time);
  std::int64_t runs() const { return runs_; }
  double used() const { return used_; }

  /// The least bound with which the first configurations fit into the estimate's time; 0 when
  /// bound_max (1 without one) does.
  double bound_for_estimate() const;
  /// With how many configurations the estimate begins.
  std::int64_t first_configurations() const;
  /// How many more the estimate tries, after the `tried` so far; 0 at its end.
  std::int64_t more_configurations(std::int64_t tried) const;
  /// From now on mean times are not rounded any more.
  void end_estimate() { estimating_ = false; }

  /// Of an experiment; during the estimate rounded up to bound_digits.
  double mean_time() const;
  /// Experiments that the rest of the time is good for; 0 when it is used up.
  std::int64_t remaining() const { return remaining_; }
  /// Takes over the mean time as it is now.
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
