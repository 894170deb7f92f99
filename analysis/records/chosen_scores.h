#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// Selects the scores that represent the designs, and the meaning of one value. Figures, tables,
/// tests and sentences all use this, so that their n agree.

/// The meaning of one value. Runs of a design are not independent of each other, so tests over runs
/// of several designs overestimate the certainty.
enum class ScoreUnit {
  Design,  ///< the mean of its runs
  Run,
};

struct ScoreChoice {
  /// As DesignScore::purpose, or `all`. Empty: for each mission and source the campaign's tests,
  /// including further profiles, or the later scores if there are no tests. So later evaluations by
  /// a user do not change the numbers of a campaign that tests its winners.
  std::string purpose;
  /// Empty: a design; but a run if no combination of mission, method and source has several
  /// designs.
  std::optional<ScoreUnit> unit;

  friend bool operator==(const ScoreChoice&, const ScoreChoice&) = default;
};

struct ChosenScores {
  std::vector<DesignScore> scores;  ///< in their original order
  ScoreUnit unit = ScoreUnit::Design;
  std::string said;  ///< for captions: "a value is a design: the mean of its tests"
};

ChosenScores chosen(std::vector<DesignScore> scores, const ScoreChoice& choice);

/// A value in a figure, a table or a test.
struct ScoreValue {
  /// The score of the run. For a design: the score of its first run with the mean instead of the
  /// score, and purpose `all` if its runs have several purposes.
  DesignScore score;
  std::vector<double> runs;
};

/// In the order of the scores.
std::vector<ScoreValue> values_of(const ChosenScores& taken);

/// A warning if designs have scores from two sources but ran on different seeds in them: a
/// difference may then come from the seeds. No warning for robots, whose runs have no seeds.
std::optional<std::string> seeds_differ(const std::vector<DesignScore>& scores,
                                        const std::string& first, const std::string& second);

}  // namespace swarmsmith
