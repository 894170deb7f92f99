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

/// The parts of a kind of score. Each kind is a struct that lists its parameters with a function
/// template `fields(rule, visitor)`, which calls `visitor(ScoreField, member)` for each of them, in
/// a fixed order. Visitors read and write campaign files, stored texts and messages, without code
/// for particular kinds. A parameter is a double, int, bool, Rgb, When, std::string or
/// std::vector<Reward>. `unit()` gives the unit of the score, for axes. A kind may also have
/// `std::optional<ScoreFault> fault() const`, for errors that the limits of a parameter cannot
/// express.

/// One parameter of a kind of score, as a key of [mission.score].
struct ScoreField {
  std::string_view key;
  std::string_view meaning;  ///< with its unit, for the table in docs/campaign-file.md
  /// Limits of numbers and rewards, both included.
  double least = -1e9;
  double most = 1e9;
  /// Whether a file must give it; otherwise the default of the struct is used.
  bool required = false;
  /// The allowed values of a text; empty: any text.
  std::span<const std::string_view> choices{};

  /// False for NaN.
  bool allows(double value) const { return value >= least && value <= most; }
};

/// The error in a rule.
struct ScoreFault {
  std::string_view key;
  std::string what;  ///< continues the sentence that begins "the score's `key`"
};

/// The instants that a score evaluates.
enum class When {
  End,  ///< once, at the last instant
  Sum   ///< every instant of 0.1 s; the values are summed, not averaged
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

/// The unit of a score that counts these things at these instants: "robots", "robots, summed over
/// instants".
inline std::string summed_unit(std::string_view counted, When at) {
  return std::string(counted) + (at == When::Sum ? ", summed over instants" : "");
}

/// The parameter `at` of the kinds that have it.
inline constexpr ScoreField kAtField{
    .key = "at",
    .meaning = R"(`"end"`: the value at the last instant; `"sum"`: the sum over all instants)"};

/// The reward for standing on a colour.
struct Reward {
  Rgb color;
  double reward = 0;

  friend bool operator==(const Reward&, const Reward&) = default;
};

/// The input of a score at an instant: the centres of the robots, and of the movable objects in the
/// arena's order.
struct Positions {
  std::span<const Point> robots;
  std::span<const Point> objects;
};

}  // namespace swarmsmith
