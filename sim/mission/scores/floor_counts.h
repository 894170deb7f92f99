#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

/// The number of points that lie on each of several floor colours, at the last instant or summed
/// over all instants. Counts are integers, so the order of points and instants does not matter.
class FloorCounts {
 public:
  /// `arena` must include the patches of this run.
  FloorCounts(std::vector<Rgb> colors, When at, Arena arena);

  void observe(std::span<const Point> points);
  /// One count per colour, in the order of the colours.
  std::vector<std::int64_t> counts() const;

 private:
  void add(std::span<const Point> points, std::vector<std::int64_t>& counts) const;

  std::vector<Rgb> colors_;
  When at_;
  Arena arena_;
  std::vector<Point> last_;         ///< for the count at the end, which looks up the floor only
                                    ///< when requested
  std::vector<std::int64_t> sums_;  ///< for the sum
};

}  // namespace swarmsmith
