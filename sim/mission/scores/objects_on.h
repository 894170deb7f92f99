#pragma once

#include "sim/mission/scores/floor_counts.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class ObjectsOnScorer;

/// Number of movable objects whose centre is on floor of `color`: the score for missions in which
/// robots push objects to a place. With `at` "sum", earlier is better.
struct ObjectsOn {
  static constexpr std::string_view kKind = "objects_on";
  using Scorer = ObjectsOnScorer;

  Rgb color{0, 0, 0};
  When at = When::End;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "color", .meaning = "colour of the floor where objects count", .required = true},
          rule.color);
    field(kAtField, rule.at);
  }
  std::string unit() const { return summed_unit("objects", at); }
  friend bool operator==(const ObjectsOn&, const ObjectsOn&) = default;
};

class ObjectsOnScorer {
 public:
  ObjectsOnScorer(const ObjectsOn& rule, const Arena& arena);

  void observe(const Positions& seen);
  double score() const;

 private:
  FloorCounts counts_;
};

}  // namespace swarmsmith
