#include "analysis/comparison/comparison_tables.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/statistics/effect_size.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string csv_number(std::optional<double> value) {
  return value ? csv_number(*value) : "";
}

std::string csv_row(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace

std::string groups_csv(const Comparison& comparison) {
  std::string csv =
      "mission,method,source,n,designs,runs,mean,sd,min,lower_quartile,median,upper_quartile,max"
      "\n";
  for (const ComparedGroup& group : comparison.groups) {
    const Summary& summary = group.summary;
    csv += csv_row({csv_field(group.mission), csv_field(group.method), csv_field(group.source),
                    fmt::format("{}", summary.n), fmt::format("{}", group.designs),
                    fmt::format("{}", group.runs), csv_number(summary.mean), csv_number(summary.sd),
                    csv_number(summary.least), csv_number(summary.lower_quartile),
                    csv_number(summary.median), csv_number(summary.upper_quartile),
                    csv_number(summary.most)});
  }
  return csv;
}

std::string pairs_csv(const Comparison& comparison) {
  std::string csv =
      "mission,method,source,first,second,n_first,n_second,test,statistic,p,p_holm,p_method,zeros,"
      "least_p,a12,magnitude,mean_difference,difference_low,difference_high,notes\n";
  for (const ComparedPair& pair : comparison.pairs) {
    csv += csv_row({csv_field(pair.mission),
                    csv_field(pair.method),
                    csv_field(pair.source),
                    csv_field(pair.first),
                    csv_field(pair.second),
                    fmt::format("{}", pair.n_first),
                    fmt::format("{}", pair.n_second),
                    pair.paired ? "signed-rank" : "rank-sum",
                    csv_number(pair.test.statistic),
                    csv_number(pair.test.p_value),
                    csv_number(pair.p_holm),
                    csv_field(method_of(pair.test)),
                    fmt::format("{}", pair.test.zeros),
                    csv_number(pair.test.least_p),
                    csv_number(pair.a12),
                    std::string(magnitude_of(pair.a12)),
                    csv_number(pair.difference.value),
                    csv_number(pair.difference.low),
                    csv_number(pair.difference.high),
                    csv_field(fmt::format("{}", fmt::join(pair.notes, "; ")))});
  }
  return csv;
}

std::string ranks_csv(const std::vector<ComparedRanks>& ranks) {
  std::string csv =
      "source,name,mean_rank,low,high,blocks,incomplete,chi_squared,degrees,p,missions\n";
  for (const ComparedRanks& ranking : ranks) {
    const FriedmanTest& test = ranking.test;
    for (std::size_t i = 0; i < ranking.names.size(); ++i) {
      const auto interval = test.interval(i).value_or(FriedmanTest::Interval{NAN, NAN});
      csv += csv_row({csv_field(ranking.source), csv_field(ranking.names[i]),
                      csv_number(test.mean_ranks[i]), csv_number(interval.low),
                      csv_number(interval.high), fmt::format("{}", test.blocks),
                      fmt::format("{}", ranking.incomplete), csv_number(test.statistic),
                      fmt::format("{}", test.degrees), csv_number(test.p_value),
                      csv_field(fmt::format("{}", fmt::join(ranking.missions, " ")))});
    }
  }
  return csv;
}

std::string_view name_of(CompareBy by) {
  switch (by) {
    case CompareBy::Source:
      return "source";
    case CompareBy::Method:
      return "method";
    case CompareBy::Mission:
      break;
  }
  return "mission";
}

std::string_view name_of(ScoreUnit unit) {
  return unit == ScoreUnit::Design ? "design" : "run";
}

}  // namespace swarmsmith
