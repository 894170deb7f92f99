#include "sim/mission/scores/floor_counts.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {

FloorCounts::FloorCounts(std::vector<Rgb> colors, When at, Arena arena)
    : colors_(std::move(colors)), at_(at), arena_(std::move(arena)), sums_(colors_.size()) {}

void FloorCounts::observe(std::span<const Point> points) {
  if (at_ == When::End) {
    last_.assign(points.begin(), points.end());
  } else {
    add(points, sums_);
  }
}

std::vector<std::int64_t> FloorCounts::counts() const {
  std::vector<std::int64_t> counts = sums_;
  if (at_ == When::End) add(last_, counts);
  return counts;
}

void FloorCounts::add(std::span<const Point> points, std::vector<std::int64_t>& counts) const {
  for (const Point point : points) {
    const auto color = std::ranges::find(colors_, floor_at(arena_, point));
    if (color != colors_.end()) ++counts[static_cast<std::size_t>(color - colors_.begin())];
  }
}

}  // namespace swarmsmith
