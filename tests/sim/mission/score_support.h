#pragma once

#include <vector>

#include "base/rng.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The base floor and a black disc.
inline Arena some_arena() {
  return {.walls = {}, .patches = {{Disc{{0, 0}, 0.6}, {0, 0, 0}}}};
}

inline double score_after(Scorer scorer, const std::vector<std::vector<Point>>& instants) {
  for (const std::vector<Point>& robots : instants)
    scorer.observe(robots);
  return scorer.score();
}

inline std::vector<std::vector<Point>> random_walks(int instants) {
  Rng rng(2);
  std::vector<std::vector<Point>> walks;
  for (int i = 0; i < instants; ++i) {
    std::vector<Point>& robots = walks.emplace_back();
    for (int r = 0; r < 3; ++r)
      robots.push_back({rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2)});
  }
  return walks;
}

}  // namespace swarmsmith
