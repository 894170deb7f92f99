#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/clock.h"

namespace swarmsmith {

/// How often times were how long. One set of bounds for all, from the shortest evaluation to a
/// program of a quarter of an hour, three a decade at most: Prometheus wants them fixed.
struct Histogram {
  /// Upper ends, in seconds; what is longer falls behind the last.
  static constexpr std::array<double, 15> kBounds = {
      0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000};

  std::array<std::uint64_t, kBounds.size() + 1> counts{};  ///< each of its own bound only
  double sum = 0;                                          ///< seconds

  /// Less than none, of a clock that was set back, counts as none.
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

/// Numbers of one campaign for people, counted since the start of this process.
struct CampaignMeters {
  std::uint64_t leased = 0;  ///< tasks, each time that a worker got one
  std::uint64_t done = 0;
  std::uint64_t rejected = 0;
  std::uint64_t no_score = 0;   ///< attempts that a worker said have none
  std::uint64_t timed_out = 0;  ///< attempts that took too long
  Histogram evaluation;         ///< what the worker measured
  Histogram queue_wait;         ///< from wanted to first leased
  Histogram round_trip;         ///< from leased to the result's arrival
};

}  // namespace swarmsmith
