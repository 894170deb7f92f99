#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/clock.h"

namespace swarmsmith {

/// A histogram of times. All histograms have the same bounds, because Prometheus needs fixed ones:
/// from the shortest evaluation to a program that takes a quarter of an hour, with at most three
/// bounds per decade.
struct Histogram {
  /// Upper bounds in seconds; longer times are counted after the last bound.
  static constexpr std::array<double, 15> kBounds = {
      0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000};

  std::array<std::uint64_t, kBounds.size() + 1> counts{};  ///< not cumulative
  double sum = 0;                                          ///< seconds

  /// A negative time, from a clock that was set back, counts as zero.
  void observe(double seconds) {
    seconds = std::max(seconds, 0.0);
    const auto bound = std::ranges::lower_bound(kBounds, seconds);
    ++counts[static_cast<std::size_t>(bound - kBounds.begin())];
    sum += seconds;
  }
  void observe(Duration time) { observe(std::chrono::duration<double>(time).count()); }

  std::uint64_t count() const {
    std::uint64_t total = 0;
    for (const std::uint64_t one : counts)
      total += one;
    return total;
  }
};

/// Counts and times of one campaign for people, since the start of this process.
struct CampaignMeters {
  std::uint64_t leased = 0;  ///< leases of tasks, repeated ones included
  std::uint64_t done = 0;
  std::uint64_t rejected = 0;
  std::uint64_t no_score = 0;   ///< attempts without a score, as reported by a worker
  std::uint64_t timed_out = 0;  ///< attempts that took too long
  Histogram evaluation;         ///< as measured by the worker
  Histogram queue_wait;         ///< from when it is wanted to its first lease
  Histogram round_trip;         ///< from the lease to the result's arrival
};

}  // namespace swarmsmith
