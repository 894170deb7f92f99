#pragma once

#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/compiled_formula.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class FormulaScorer;

inline constexpr std::array<std::string_view, 3> kFormulaSubjects = {"robots", "objects", "swarm"};
inline constexpr std::array<std::string_view, 4> kFormulaFolds = {"sum", "mean", "min", "max"};

/// A score given by a formula in the campaign file, so that users need no compiler for their own
/// score. `value` is computed at each instant for each robot, for each movable object, or once for
/// the swarm; `over` combines the values. docs/missions.md lists the names that a formula may use.
struct Formula {
  static constexpr std::string_view kKind = "formula";
  using Scorer = FormulaScorer;

  std::string value = "0";
  std::string of = "robots";
  std::string over = "sum";
  When at = When::End;
  std::string unit_text;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "value",
           .meaning = "the formula, such as `\"black - 0.1 * nearest\"`",
           .required = true},
          rule.value);
    field({.key = "of",
           .meaning =
               "what it is computed for: each robot, each movable object, or once for the swarm",
           .choices = kFormulaSubjects},
          rule.of);
    field({.key = "over",
           .meaning = "how the values of one instant are combined into one",
           .choices = kFormulaFolds},
          rule.over);
    field(kAtField, rule.at);
    field({.key = "unit", .meaning = "what the score counts, for the axes of figures"},
          rule.unit_text);
  }
  std::string unit() const { return unit_text; }
  std::optional<ScoreFault> fault() const;
  friend bool operator==(const Formula&, const Formula&) = default;
};

class FormulaScorer {
 public:
  FormulaScorer(const Formula& rule, Arena arena);

  /// A robot or object must keep its index in `seen` for a whole run.
  void observe(const Positions& seen);
  double score() const;

 private:
  double value_of_instant() const;

  Formula rule_;
  Arena arena_;
  CompiledFormula formula_;
  bool needs_floor_;
  int instant_ = 0;
  std::vector<Point> robots_;
  std::vector<Point> objects_;
  std::vector<Point> robots_before_;  ///< positions at the previous instant, for speeds
  std::vector<Point> objects_before_;
  double sum_ = 0;
};

}  // namespace swarmsmith
