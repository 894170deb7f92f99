#include "sim/mission/scores/coverage.h"

#include <cstddef>

namespace swarmsmith {
namespace {

/// Sum of the ages 0, 1, ..., duration - 1 of a tile during `duration` instants.
std::int64_t sum_of_ages(std::int64_t duration) {
  return duration * (duration - 1) / 2;
}

}  // namespace

CoverageScorer::CoverageScorer(const Coverage& rule, const Arena& /*arena*/)
    : rule_(rule), tiles_per_metre_(rule.tiles / rule.side_m) {
  // At the first instant all tiles have age 0, visited or not (rvr-automode facts, section 8).
  const auto tiles = static_cast<std::size_t>(rule.tiles);
  visited_.assign(tiles * tiles, 1);
}

/// A robot outside the square of tiles visits none.
void CoverageScorer::observe(const Positions& seen) {
  ++instant_;
  const double tiles = rule_.tiles;
  for (const Point& robot : seen.robots) {
    const double column = robot.x * tiles_per_metre_ + 0.5 * tiles;
    const double row = robot.y * tiles_per_metre_ + 0.5 * tiles;
    if (!(column >= 0 && column < tiles && row >= 0 && row < tiles)) continue;
    const std::size_t tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(rule_.tiles) +
                             static_cast<std::size_t>(column);
    // The ages since the last visit are summed in one step, so that an instant costs one operation
    // per robot instead of one per tile. A second robot on the tile adds sum_of_ages(0) = 0.
    age_sum_ += sum_of_ages(instant_ - visited_[tile]);
    visited_[tile] = instant_;
  }
}

double CoverageScorer::score() const {
  std::int64_t sum = age_sum_;
  for (const std::int64_t visited : visited_)
    sum += sum_of_ages(instant_ + 1 - visited);
  const double tiles = rule_.tiles;
  return sum == 0 ? 0.0 : -static_cast<double>(sum) / (tiles * tiles);
}

}  // namespace swarmsmith
