#include "sim/mission/score.h"

#include <cstddef>
#include <stdexcept>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

/// Sum of the ages 0, 1, ..., duration - 1 that a tile goes through in `duration` instants.
std::int64_t sum_of_ages(std::int64_t duration) {
  return duration * (duration - 1) / 2;
}

double reward_of(const ColorReward& rule, Rgb color) {
  for (const ColorReward::Reward& reward : rule.rewards) {
    if (reward.color == color) return reward.reward;
  }
  return 0;
}

}  // namespace

Scorer::Scorer(const ScoreRule& rule, const Arena& arena) : rule_(rule), arena_(arena) {
  const auto* coverage = std::get_if<Coverage>(&rule_);
  if (coverage == nullptr) return;
  if (coverage->tiles < 1 || !(coverage->side_m > 0)) {
    throw std::invalid_argument("coverage needs at least one tile and a side longer than 0");
  }
  // At the first instant all tiles are of age 0, visited or not (rvr-automode facts, section 8).
  const auto tiles = static_cast<std::size_t>(coverage->tiles);
  visited_.assign(tiles * tiles, 1);
}

void Scorer::observe(std::span<const Point> robots) {
  ++instant_;
  if (const auto* coverage = std::get_if<Coverage>(&rule_)) {
    visit_tiles(*coverage, robots);
  } else {
    last_.assign(robots.begin(), robots.end());
  }
}

/// A robot outside of the square of tiles visits none.
void Scorer::visit_tiles(const Coverage& rule, std::span<const Point> robots) {
  const double tiles = rule.tiles;
  const double per_metre = tiles / rule.side_m;
  for (const Point& robot : robots) {
    const double column = robot.x * per_metre + 0.5 * tiles;
    const double row = robot.y * per_metre + 0.5 * tiles;
    if (!(column >= 0 && column < tiles && row >= 0 && row < tiles)) continue;
    const std::size_t tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(rule.tiles) +
                             static_cast<std::size_t>(column);
    age_sum_ += sum_of_ages(instant_ - visited_[tile]);
    visited_[tile] = instant_;
  }
}

double Scorer::coverage_score(const Coverage& rule) const {
  std::int64_t sum = age_sum_;
  for (const std::int64_t visited : visited_)
    sum += sum_of_ages(instant_ + 1 - visited);
  const double tiles = rule.tiles;
  return sum == 0 ? 0.0 : -static_cast<double>(sum) / (tiles * tiles);
}

double Scorer::score() const {
  return std::visit(Overloaded{[this](const RobotsOn& rule) {
                                 double robots = 0;
                                 for (const Point& robot : last_) {
                                   if (floor_at(arena_, robot) == rule.color) ++robots;
                                 }
                                 return robots;
                               },
                               [this](const Coverage& rule) { return coverage_score(rule); },
                               [this](const ColorReward& rule) {
                                 double sum = 0;
                                 for (const Point& robot : last_) {
                                   sum += reward_of(rule, floor_at(arena_, robot));
                                 }
                                 return sum;
                               }},
                    rule_);
}

}  // namespace swarmsmith
