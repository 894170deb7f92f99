#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/score_rule.h"

namespace swarmsmith {

/// Scores depend only on the positions of the centres of robots and objects at each instant, and on
/// the floor. A simulator feeds a scorer while it runs; a trajectory from a camera is scored
/// afterwards. Larger is better. docs/missions.md explains how to add a kind.

/// The names of all kinds, in the order of the list.
std::vector<std::string> score_kinds();

/// A score of this kind with the default parameters of its struct; nothing for an unknown kind.
std::optional<ScoreRule> score_of_kind(std::string_view kind);

std::string_view kind_of(const ScoreRule& rule);

/// The unit of the score, such as "robots"; empty when unknown.
std::string unit_of(const ScoreRule& rule);

/// Calls `visitor(ScoreField, member)` for each parameter of the rule; `Rule` is ScoreRule or
/// const.
template <class Rule, class Visitor>
void visit_fields(Rule& rule, Visitor& visitor) {
  std::visit([&](auto& kind) { kind.fields(kind, visitor); }, rule);
}

/// The first parameter that is outside its limits or not finite, with its key as `where`. Rewards
/// must name at least one colour, and each colour only once.
std::optional<Error> fault_of(const ScoreRule& rule);

/// The variant of the scorers of all kinds in a rule.
template <class Rule>
struct ScorersOf;
template <class... Rules>
struct ScorersOf<std::variant<Rules...>> {
  using Type = std::variant<typename Rules::Scorer...>;
};

/// Observes the positions of all robots and objects at each global instant (every 0.1 s, first at
/// 0.1 s) and gives the score of the observed instants. Independent of the order of the robots.
class Scorer {
 public:
  /// `arena` must include the patches of this run; it is copied. Throws std::invalid_argument when
  /// the rule has a fault.
  Scorer(const ScoreRule& rule, const Arena& arena);

  void observe(std::span<const Point> robots, std::span<const Point> objects = {});
  double score() const;

 private:
  ScorersOf<ScoreRule>::Type scorer_;
};

}  // namespace swarmsmith
