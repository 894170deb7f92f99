#pragma once

#include <cstdint>
#include <deque>
#include <map>

namespace swarmsmith {

/// Delays from having a frame to having its poses. A camera may film for days: they are counted in
/// steps of 0.1 %, so that memory is bounded.
class LiveDelays {
 public:
  void add(double delay_s);
  /// The largest of the last hundred.
  double latest_most_s() const;
  /// The one that a share of all is below, to 0.05 %; 0 for none.
  double quantile_s(double share) const;

 private:
  std::deque<double> latest_;
  std::map<std::int64_t, std::int64_t> counts_;  ///< by steps of their logarithm
  std::int64_t all_ = 0;
};

}  // namespace swarmsmith
