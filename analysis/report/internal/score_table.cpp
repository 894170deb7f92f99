#include "analysis/report/internal/score_table.h"

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "analysis/statistics/summary.h"

namespace swarmsmith {
namespace {

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
    std::vector<std::string> row;
    if (by_design) row.push_back(to_string(design));
    row.insert(row.end(), {mission, method, source, purpose});
    if (!by_design) row.push_back(fmt::format("{}", group.designs.size()));
    const Summary summary = summary_of(group.scores);
    row.push_back(fmt::format("{}", summary.n));
    row.push_back(shown_number(summary.mean));
    row.push_back(summary.n < 2 ? "-" : shown_number(summary.sd));
    for (const double value : {summary.least, summary.lower_quartile, summary.median,
                               summary.upper_quartile, summary.most}) {
      row.push_back(shown_number(value));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace swarmsmith
