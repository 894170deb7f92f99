#pragma once

#include "sim/mission/scores/floor_counts.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class RobotsOnScorer;

/// Number of robots on floor of `color` (thesis eq. 6.1). With `at` "sum" it is the anytime
/// variant: the number of cycles, summed over robots, on that floor.
struct RobotsOn {
  static constexpr std::string_view kKind = "robots_on";
  using Scorer = RobotsOnScorer;

  Rgb color{0, 0, 0};
  When at = When::End;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "color", .meaning = "colour of the floor where robots count", .required = true},
          rule.color);
    field(kAtField, rule.at);
  }
  std::string unit() const { return summed_unit("robots", at); }
  friend bool operator==(const RobotsOn&, const RobotsOn&) = default;
};

class RobotsOnScorer {
 public:
  RobotsOnScorer(const RobotsOn& rule, const Arena& arena);

  void observe(const Positions& seen);
  double score() const;

 private:
  FloorCounts counts_;
};

}  // namespace swarmsmith
