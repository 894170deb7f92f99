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

/// A question that a run was asked before its score counts, so that a reader can weigh the verdict:
/// what was measured, its limit, and what the answer would have caught. One that could not be asked
/// says why.
struct Check {
  enum class Outcome { Passed, Warned, Failed, NotRun };

  std::string name;     ///< of a fixed set: "length of the film"
  std::string subject;  ///< the robot or camera; empty for the run as a whole
  Outcome outcome = Outcome::Passed;
  std::optional<double> value;  ///< in `unit`
  std::optional<double> limit;  ///< in `unit`; beyond it the check fails, or warns
  std::string unit;             ///< "mm", "s", "%"; empty for a plain number
  std::string catches;          ///< "a film at the wrong speed"
  std::string reason;           ///< why it could not be asked; empty for all others

  friend bool operator==(const Check&, const Check&) = default;
};

/// In the order in which people look at them.
inline constexpr std::array kWorstFirst{Check::Outcome::Failed, Check::Outcome::Warned,
                                        Check::Outcome::NotRun, Check::Outcome::Passed};
std::string_view name_of(Check::Outcome outcome);  ///< "passed", "warned", "failed", "not run"

/// What all answers to a question share.
struct Question {
  std::string_view name;
  std::string_view unit;
  std::string_view catches;
};
Check answered(const Question& question, std::string subject, Check::Outcome outcome,
               std::optional<double> value = {}, std::optional<double> limit = {});
Check not_asked(const Question& question, std::string subject, std::string reason);

/// Failed or warned, as the worst issue says from number `first` on; only those of `code`, if
/// given.
Check::Outcome outcome_of(std::span<const Issue> issues, std::size_t first = 0,
                          std::optional<IssueCode> code = {});

/// "0.83 s", "" when there is no number; and of its limit, "at most 1 s".
std::string value_text(const Check& check);
std::string limit_text(const Check& check);

/// What could not be asked, each name once: "length of the film", "motion as commanded (rvr2)" when
/// it could be asked of others.
std::vector<std::string> unasked(std::span<const Check> checks);

}  // namespace swarmsmith
