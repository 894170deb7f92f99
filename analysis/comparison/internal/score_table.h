#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/comparison/comparison.h"
#include "analysis/records/names.h"

namespace swarmsmith {

/// Sorts scores into groups that can be compared.

/// The instance and seed of a design's run.
struct RunKey {
  std::int64_t instance = 0;
  std::int64_t seed = 0;

  friend auto operator<=>(const RunKey&, const RunKey&) = default;
};

/// The scores of a design in one source.
struct ScoredDesign {
  std::vector<double> scores;  ///< in the order of the records
  std::map<RunKey, std::vector<double>>
      by_place;  ///< the same scores by instance and seed; usually one each
};
using ScoredDesigns = std::map<DesignId, ScoredDesign>;

struct GroupKey {
  std::string mission;
  std::string method;
  std::string source;

  friend bool operator<(const GroupKey& a, const GroupKey& b);
};
using ScoreTable = std::map<GroupKey, ScoredDesigns>;

/// The scores that the options select.
ChosenScores wanted(std::vector<DesignScore> scores, const ComparisonOptions& options);

ScoreTable score_table(const std::vector<DesignScore>& scores);

/// The distinct values of one part of the keys.
using Names = std::set<std::string, NameOrder>;
Names names_in(const ScoreTable& table, std::string GroupKey::*part);

/// One value per design, or one per run.
std::vector<double> values_of(const ScoredDesigns& designs, ScoreUnit unit);

/// Append the meaningful pairs with their tests, without Holm's correction. Data that were left out
/// are mentioned in `notes`.
void add_source_pairs(const ScoreTable& table, Comparison& comparison);
void add_method_pairs(const ScoreTable& table, Comparison& comparison);

/// Append the rankings that the designs allow.
void add_source_ranks(const ScoreTable& table, Comparison& comparison);
void add_method_ranks(const ScoreTable& table, Comparison& comparison);

}  // namespace swarmsmith
