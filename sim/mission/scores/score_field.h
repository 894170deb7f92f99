#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// What kinds of score are made of. Each is a struct that lists its parameters with a function
/// template `fields(rule, visitor)`, which calls `visitor(ScoreField, member)` for each of them, in
/// a fixed order. Campaign files, stored texts and messages are read and written by visitors, so
/// that they know no kind by name. A parameter is a double, int, bool, Rgb, When, std::string
/// or std::vector<Reward>. `unit()` says what its score counts, for axes. A kind may have
/// `std::optional<ScoreFault> fault() const` besides, for what the limits of a parameter cannot
/// say.

/// One parameter of a kind of score, as a key of [mission.score].
struct ScoreField {
  std::string_view key;
  std::string_view meaning;  ///< with its unit, for the table in docs/campaign-file.md
  /// Limits of numbers and rewards, both included.
  double least = -1e9;
  double most = 1e9;
  /// A file must say it; else it is what the struct says.
  bool required = false;
  /// What a text may be; empty: anything.
  std::span<const std::string_view> choices{};

  /// Not for NaN.
  bool allows(double value) const { return value >= least && value <= most; }
};

/// What is wrong with a rule.
struct ScoreFault {
  std::string_view key;
  std::string what;  ///< goes on after "the score's `key`"
};

/// When a score looks at the swarm.
enum class When {
  End,  ///< once, at the last instant
  Sum   ///< at every instant of 0.1 s; what it sees is added up, and divided by nothing
};

inline constexpr std::array<std::string_view, 2> kWhenNames = {"end", "sum"};

constexpr std::string_view name_of(When when) {
  return kWhenNames[static_cast<std::size_t>(when)];
}

constexpr std::optional<When> when_from_name(std::string_view name) {
  for (const When when : {When::End, When::Sum}) {
    if (name == name_of(when)) return when;
  }
  return std::nullopt;
}

/// What a score counts that looks at the swarm so: "robots", "robots, summed over instants".
inline std::string summed_unit(std::string_view counted, When at) {
  return std::string(counted) + (at == When::Sum ? ", summed over instants" : "");
}

/// The parameter `at` of the kinds that have it.
inline constexpr ScoreField kAtField{
    .key = "at",
    .meaning = R"(`"end"`: as it is at the last instant; `"sum"`: summed over all instants)"};

/// What standing on a colour is worth.
struct Reward {
  Rgb color;
  double reward = 0;

  friend bool operator==(const Reward&, const Reward&) = default;
};

/// What a score sees at an instant: the centres of the robots and those of the arena's movable
/// objects, the latter in the arena's order.
struct Positions {
  std::span<const Point> robots;
  std::span<const Point> objects;
};

}  // namespace swarmsmith
