#pragma once

#include <optional>
#include <string>
#include <string_view>

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

std::string_view name_of(Check::Outcome outcome);  ///< "passed", "warned", "failed", "not run"

}  // namespace swarmsmith
