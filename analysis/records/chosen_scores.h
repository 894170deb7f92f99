#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// Which scores stand for the designs, and what one value is: the same in figures, tables, tests
/// and sentences, so that their n are the same.

/// What one value is. Runs of a design are not independent of each other, so that tests over runs
/// of several designs see more certainty than there is.
enum class ScoreUnit {
  Design,  ///< the mean of its runs
  Run,
};

struct ScoreChoice {
  /// As DesignScore::purpose; `all`. Empty: of each mission and source the campaign's tests,
  /// further profiles included, and where there are none what was asked for later. So nothing that
  /// a user evaluates afterwards changes the numbers of a campaign that tests its winners.
  std::string purpose;
  /// None: a design, but a run where no mission, method and source has more than one design.
  std::optional<ScoreUnit> unit;

  friend bool operator==(const ScoreChoice&, const ScoreChoice&) = default;
};

struct ChosenScores {
  std::vector<DesignScore> scores;  ///< in their order
  ScoreUnit unit = ScoreUnit::Design;
  std::string said;  ///< for captions: "a value is a design: the mean of its tests"
};

ChosenScores chosen(std::vector<DesignScore> scores, const ScoreChoice& choice);

/// A value of a figure, a table or a test.
struct ScoreValue {
  /// That of the run; for a design that of its first run, with the mean as its score, and purpose
  /// `all` where its runs have several.
  DesignScore score;
  std::vector<double> runs;
};

/// In the order of the scores.
std::vector<ScoreValue> values_of(const ChosenScores& taken);

/// A warning where designs have scores of two sources and ran on other seeds in the one than in the
/// other: their difference then is one of seeds, too. None for robots, whose runs have no seeds.
std::optional<std::string> seeds_differ(const std::vector<DesignScore>& scores,
                                        const std::string& first, const std::string& second);

}  // namespace swarmsmith
