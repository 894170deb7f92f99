#pragma once

#include <cstdint>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class CoverageScorer;

/// Minus the mean age of the tiles, summed over the control cycles (thesis eq. 6.2). There are
/// `tiles` x `tiles` tiles on a centred square of side `side_m`; ages are in cycles.
struct Coverage {
  static constexpr std::string_view kKind = "coverage";
  using Scorer = CoverageScorer;

  int tiles = 10;
  double side_m = 2.50001;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "tiles",
           .meaning = "number of tiles along each side of the square",
           .least = 1,
           .most = 1000},
          rule.tiles);
    field({.key = "side", .meaning = "side of the square, m", .least = 0.01, .most = 1000},
          rule.side_m);
  }
  static std::string unit() { return "cycles"; }
  friend bool operator==(const Coverage&, const Coverage&) = default;
};

class CoverageScorer {
 public:
  CoverageScorer(const Coverage& rule, const Arena& arena);

  void observe(const Positions& seen);
  double score() const;

 private:
  Coverage rule_;
  double tiles_per_metre_;
  /// Instead of ages, the instant at which each tile last had age 0, and the sum of the ages up to
  /// those instants.
  std::vector<std::int64_t> visited_;
  std::int64_t instant_ = 0;
  std::int64_t age_sum_ = 0;
};

}  // namespace swarmsmith
