#include "analysis/report/internal/score_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <fmt/format.h>

namespace swarmsmith {
namespace {

/// Of ordered values, at least one; R's type 7 (Hyndman and Fan 1996, definition 7).
double quantile(const std::vector<double>& ordered, double part) {
  const double place = part * static_cast<double>(ordered.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ordered.size() - 1);
  return ordered[below] + (place - std::floor(place)) * (ordered[above] - ordered[below]);
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

/// "-" of a single value.
std::string deviation_text(const std::vector<double>& values) {
  if (values.size() < 2) return "-";
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values)
    sum += (value - mean) * (value - mean);
  return shown_number(std::sqrt(sum / static_cast<double>(values.size() - 1)));
}

struct Group {
  std::set<DesignId> designs;
  std::vector<double> scores;
};

/// Mission, method, design (0 when designs are one group), source, purpose.
using Key = std::tuple<std::string, std::string, DesignId, std::string, std::string>;

}  // namespace

HtmlTable score_table(const std::string& caption, std::span<const DesignScore> scores,
                      ScoreGroups groups) {
  const bool by_design = groups == ScoreGroups::OfDesigns;
  HtmlTable table{.caption = caption};
  if (by_design) {
    table.columns = {{"design"}, {"mission"}, {"method"}, {"source"}, {"purpose"}};
  } else {
    table.columns = {{"mission"}, {"method"}, {"source"}, {"purpose"}, {"designs", true}};
  }
  for (const char* number :
       {"n", "mean", "sd", "least", "1st quartile", "median", "3rd quartile", "most"}) {
    table.columns.push_back({number, true});
  }
  std::map<Key, Group> found;
  for (const DesignScore& score : scores) {
    Group& group = found[{score.mission, score.method, by_design ? score.design : DesignId{},
                          score.source, score.purpose}];
    group.designs.insert(score.design);
    group.scores.push_back(score.score);
  }
  for (auto& [key, group] : found) {
    const auto& [mission, method, design, source, purpose] = key;
    std::ranges::sort(group.scores);
    std::vector<std::string> row;
    if (by_design) row.push_back(to_string(design));
    row.insert(row.end(), {mission, method, source, purpose});
    if (!by_design) row.push_back(fmt::format("{}", group.designs.size()));
    row.push_back(fmt::format("{}", group.scores.size()));
    row.push_back(shown_number(mean_of(group.scores)));
    row.push_back(deviation_text(group.scores));
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0})
      row.push_back(shown_number(quantile(group.scores, part)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace swarmsmith
