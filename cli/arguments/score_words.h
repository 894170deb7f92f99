#pragma once

#include <string>

#include "analysis/records/chosen_scores.h"

namespace swarmsmith::cli {

/// Help for `--purpose` and `--per`, for all commands about the winners' scores.
inline constexpr const char* kPurposeHelp =
    "Which scores: of the campaign's tests, of later evaluations, or all (default: tests; for a "
    "source without tests, later evaluations)";
inline constexpr const char* kPerHelp =
    "What one value is (default design: the mean of its runs; run where each group is one design)";

inline ScoreChoice score_choice(const std::string& purpose, const std::string& per) {
  ScoreChoice choice{.purpose = purpose, .unit = {}};
  if (!per.empty()) choice.unit = per == "run" ? ScoreUnit::Run : ScoreUnit::Design;
  return choice;
}

}  // namespace swarmsmith::cli
