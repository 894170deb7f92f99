#pragma once

#include <cstdint>
#include <deque>
#include <map>

namespace swarmsmith {

/// Delays between the arrival of a frame and its poses. A camera may film for days, so delays are
/// counted in steps of 0.1 %, which bounds the memory.
class LiveDelays {
 public:
  void add(double delay_s);
  /// The largest of the last hundred delays.
  double latest_most_s() const;
  /// The quantile of all delays, precise to 0.05 %; 0 without delays.
  double quantile_s(double share) const;

 private:
  std::deque<double> latest_;
  std::map<std::int64_t, std::int64_t> counts_;  ///< number of delays per step of their logarithm
  std::int64_t all_ = 0;
};

}  // namespace swarmsmith
