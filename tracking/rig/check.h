#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tracking/rig/issue.h"

namespace swarmsmith {

/// A check of a run before its score counts. It tells a reader how well founded the verdict is: the
/// measured value, its limit, and the mistake that the check would have found. A check that could
/// not be done gives the reason.
struct Check {
  enum class Outcome { Passed, Warned, Failed, NotRun };

  std::string name;     ///< one of a fixed set: "length of the film"
  std::string subject;  ///< the robot or camera; empty if it is the whole run
  Outcome outcome = Outcome::Passed;
  std::optional<double> value;  ///< in `unit`
  std::optional<double> limit;  ///< in `unit`; beyond it the check fails or warns
  std::string unit;             ///< "mm", "s", "%"; empty for a plain number
  std::string catches;          ///< the mistake it finds: "a film at the wrong speed"
  std::string reason;           ///< why it could not be done; empty for all other outcomes
  /// Whether the limit is the least value. Without it, it follows from outcome and value; that is
  /// wrong only for a check that can fail for another reason than its value.
  std::optional<bool> limit_is_least = std::nullopt;

  friend bool operator==(const Check&, const Check&) = default;
};

/// The outcomes in the order in which people want to read them.
inline constexpr std::array kWorstFirst{Check::Outcome::Failed, Check::Outcome::Warned,
                                        Check::Outcome::NotRun, Check::Outcome::Passed};
std::string_view name_of(Check::Outcome outcome);  ///< "passed", "warned", "failed", "not run"

/// The parts that are the same in all checks of one kind.
struct Question {
  std::string_view name;
  std::string_view unit;
  std::string_view catches;
};
Check answered(const Question& question, std::string subject, Check::Outcome outcome,
               std::optional<double> value = {}, std::optional<double> limit = {});
Check not_asked(const Question& question, std::string subject, std::string reason);

/// The outcome that follows from the issues from index `first` on: failed if one is an error,
/// warned if one is a warning. If `code` is given, only issues with this code count.
Check::Outcome outcome_of(std::span<const Issue> issues, std::size_t first = 0,
                          std::optional<IssueCode> code = {});

/// The value as text, "0.83 s", or "" without a value; and the limit as text, "at most 1 s".
std::string value_text(const Check& check);
std::string limit_text(const Check& check);

/// The names of checks that were not done, each once: "length of the film"; or "motion as commanded
/// (rvr2)" if the check was done for other robots.
std::vector<std::string> unasked(std::span<const Check> checks);

}  // namespace swarmsmith
