#include "analysis/comparison/internal/score_table.h"

#include <algorithm>

namespace swarmsmith {
namespace {

bool is_wanted(const DesignScore& score, const ComparisonOptions& options) {
  const auto fits = [](const std::string& wanted, const std::string& value) {
    return wanted.empty() || wanted == value;
  };
  return fits(options.method, score.method) && fits(options.source, score.source) &&
         (options.missions.empty() ||
          std::ranges::find(options.missions, score.mission) != options.missions.end());
}

}  // namespace

bool operator<(const GroupKey& a, const GroupKey& b) {
  if (a.mission != b.mission) return a.mission < b.mission;
  if (a.method != b.method) return a.method < b.method;
  return NameOrder()(a.source, b.source);
}

ChosenScores wanted(std::vector<DesignScore> scores, const ComparisonOptions& options) {
  std::erase_if(scores, [&](const DesignScore& score) { return !is_wanted(score, options); });
  return chosen(std::move(scores), options.choice);
}

ScoreTable score_table(const std::vector<DesignScore>& scores) {
  ScoreTable table;
  for (const DesignScore& score : scores) {
    ScoredDesign& design = table[{score.mission, score.method, score.source}][score.design];
    design.scores.push_back(score.score);
    design.by_place[{score.instance, score.seed}].push_back(score.score);
  }
  return table;
}

Names names_in(const ScoreTable& table, std::string GroupKey::*part) {
  Names names;
  for (const auto& [key, designs] : table)
    names.insert(key.*part);
  return names;
}

std::vector<double> values_of(const ScoredDesigns& designs, ScoreUnit unit) {
  std::vector<double> values;
  for (const auto& [id, design] : designs) {
    if (unit == ScoreUnit::Design) {
      values.push_back(mean_of(design.scores));
    } else {
      values.insert(values.end(), design.scores.begin(), design.scores.end());
    }
  }
  return values;
}

}  // namespace swarmsmith
