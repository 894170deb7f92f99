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

/// Scores see positions of the robots' and objects' centres, instant by instant, and the floor;
/// nothing else. A simulator feeds one while it runs, a camera's trajectory is fed after the fact.
/// Larger is better. docs/missions.md says how to add a kind.

/// The names of all kinds, in the order of the list.
std::vector<std::string> score_kinds();

/// A score of that kind with its parameters as its struct has them; nothing for an unknown kind.
std::optional<ScoreRule> score_of_kind(std::string_view kind);

std::string_view kind_of(const ScoreRule& rule);

/// The unit that the score counts, such as "robots"; empty when unknown.
std::string unit_of(const ScoreRule& rule);

/// Calls `visitor(ScoreField, member)` for each parameter of the rule; `Rule` is ScoreRule or
/// const.
template <class Rule, class Visitor>
void visit_fields(Rule& rule, Visitor& visitor) {
  std::visit([&](auto& kind) { kind.fields(kind, visitor); }, rule);
}

/// The first parameter that is out of its limits or not finite, with its key as `where`; rewards
/// must name a colour, and each but once.
std::optional<Error> fault_of(const ScoreRule& rule);

/// The scorers of the kinds of a rule.
template <class Rule>
struct ScorersOf;
template <class... Rules>
struct ScorersOf<std::variant<Rules...>> {
  using Type = std::variant<typename Rules::Scorer...>;
};

/// Takes the positions of all robots and objects at each global instant (every 0.1 s, first at
/// 0.1 s) and says the score of what it saw so far. Independent of the order of the robots.
class Scorer {
 public:
  /// `arena` with the patches of this run; copied. Throws std::invalid_argument when the rule has a
  /// fault.
  Scorer(const ScoreRule& rule, const Arena& arena);

  void observe(std::span<const Point> robots, std::span<const Point> objects = {});
  double score() const;

 private:
  ScorersOf<ScoreRule>::Type scorer_;
};

}  // namespace swarmsmith
