#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

/// How many points lie on floor of each of some colours: at the last instant, or added up over all.
/// Counts are integers, so that neither the order of the points nor that of the instants matters.
class FloorCounts {
 public:
  /// `arena` with the patches of this run; copied.
  FloorCounts(std::vector<Rgb> colors, When at, Arena arena);

  void observe(std::span<const Point> points);
  /// One a colour, in their order.
  std::vector<std::int64_t> counts() const;

 private:
  void add(std::span<const Point> points, std::vector<std::int64_t>& counts) const;

  std::vector<Rgb> colors_;
  When at_;
  Arena arena_;
  std::vector<Point> last_;         ///< for the end, which looks at the floor only when asked
  std::vector<std::int64_t> sums_;  ///< for the sum
};

}  // namespace swarmsmith
