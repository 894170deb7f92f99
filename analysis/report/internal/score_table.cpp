#include "analysis/report/internal/score_table.h"

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "analysis/records/names.h"
#include "analysis/statistics/summary.h"

namespace swarmsmith {
namespace {

struct Group {
  std::set<DesignId> designs;
  std::vector<double> values;
};

/// Mission, method, source, purpose.
using Key = std::tuple<std::string, std::string, std::string, std::string>;

}  // namespace

HtmlTable score_table(const std::string& caption, const ChosenScores& taken) {
  HtmlTable table{.caption = caption,
                  .columns = {{"mission"}, {"method"}, {"source"}, {"purpose"}, {"designs", true}}};
  for (const char* number :
       {"n", "mean", "sd", "least", "1st quartile", "median", "3rd quartile", "most"}) {
    table.columns.push_back({number, true});
  }
  std::map<Key, Group> found;
  for (const auto& [score, runs] : values_of(taken)) {
    Group& group = found[{score.mission, score.method, score.source, score.purpose}];
    group.designs.insert(score.design);
    group.values.push_back(score.score);
  }
  for (const auto& [key, group] : found) {
    const auto& [mission, method, source, purpose] = key;
    const Summary summary = summary_of(group.values);
    std::vector<std::string> row = {as_words(mission),
                                    method,
                                    source,
                                    purpose,
                                    fmt::format("{}", group.designs.size()),
                                    fmt::format("{}", summary.n),
                                    shown_number(summary.mean),
                                    summary.n < 2 ? "-" : shown_number(summary.sd)};
    for (const double value : {summary.least, summary.lower_quartile, summary.median,
                               summary.upper_quartile, summary.most}) {
      row.push_back(shown_number(value));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace swarmsmith
