#pragma once

#include <cstdint>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class ForagingScorer;

/// Number of items that the robots brought from a source to the nest (Francesca et al., AutoMoDe,
/// Swarm Intelligence 8, 2014, section 4: foraging). Items are not simulated: a robot takes one
/// when its centre is on floor of the colour `source`, and leaves it when it is on floor of the
/// colour `nest`. A robot carries one item at a time; sources are never empty.
struct Foraging {
  static constexpr std::string_view kKind = "foraging";
  using Scorer = ForagingScorer;

  Rgb nest{255, 255, 255};
  Rgb source{0, 0, 0};

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "nest", .meaning = "colour of the floor where a robot leaves its item"},
          rule.nest);
    field({.key = "source", .meaning = "colour of the floor where a robot takes an item"},
          rule.source);
  }
  static std::string unit() { return "items"; }
  std::optional<ScoreFault> fault() const;
  friend bool operator==(const Foraging&, const Foraging&) = default;
};

class ForagingScorer {
 public:
  ForagingScorer(const Foraging& rule, Arena arena);

  /// A robot must keep its index in `seen.robots` for a whole run.
  void observe(const Positions& seen);
  double score() const;

 private:
  Foraging rule_;
  Arena arena_;
  std::vector<char> carries_;  ///< one per robot
  std::int64_t items_ = 0;
};

}  // namespace swarmsmith
