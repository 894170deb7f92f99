#include "cli/commands/comparison_json.h"

#include <cmath>

#include <fmt/format.h>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/statistics/effect_size.h"
#include "console/output.h"

namespace swarmsmith::cli {
namespace {

std::string number(std::optional<double> value) {
  return json_number(value.value_or(NAN));
}

template <class Items, class Text>
std::string list(const Items& items, const Text& text) {
  std::string result;
  for (const auto& item : items)
    result += (result.empty() ? "" : ",") + text(item);
  return "[" + result + "]";
}

std::string group_json(const ComparedGroup& group) {
  const Summary& summary = group.summary;
  return fmt::format(
      R"({{"mission":{},"method":{},"source":{},"n":{},"designs":{},"runs":{},"mean":{},"sd":{},)"
      R"("min":{},"lower_quartile":{},"median":{},"upper_quartile":{},"max":{}}})",
      json_text(group.mission), json_text(group.method), json_text(group.source), summary.n,
      group.designs, group.runs, json_number(summary.mean), json_number(summary.sd),
      json_number(summary.least), json_number(summary.lower_quartile), json_number(summary.median),
      json_number(summary.upper_quartile), json_number(summary.most));
}

std::string pair_json(const ComparedPair& pair) {
  return fmt::format(
      R"({{"mission":{},"method":{},"source":{},"first":{},"second":{},"n_first":{},"n_second":{},)"
      R"("test":{},"statistic":{},"p":{},"p_holm":{},"p_method":{},"zeros":{},"least_p":{},)"
      R"("a12":{},"magnitude":{},"mean_difference":{},"difference_low":{},"difference_high":{},)"
      R"("notes":{}}})",
      json_text(pair.mission), json_text(pair.method), json_text(pair.source),
      json_text(pair.first), json_text(pair.second), pair.n_first, pair.n_second,
      json_text(pair.paired ? "signed-rank" : "rank-sum"), json_number(pair.test.statistic),
      number(pair.test.p_value), number(pair.p_holm), json_text(method_of(pair.test)),
      pair.test.zeros, json_number(pair.test.least_p), json_number(pair.a12),
      json_text(magnitude_of(pair.a12)), json_number(pair.difference.value),
      json_number(pair.difference.low), json_number(pair.difference.high),
      list(pair.notes, json_text));
}

std::string ranks_json(const ComparedRanks& ranks) {
  const FriedmanTest& test = ranks.test;
  return fmt::format(
      R"({{"source":{},"names":{},"mean_ranks":{},"half_width":{},"chi_squared":{},"degrees":{},)"
      R"("p":{},"blocks":{},"incomplete":{},"missions":{}}})",
      json_text(ranks.source), list(ranks.names, json_text), list(test.mean_ranks, json_number),
      number(test.half_width), json_number(test.statistic), test.degrees, number(test.p_value),
      test.blocks, ranks.incomplete, list(ranks.missions, json_text));
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  return fmt::format(R"({{"by":"{}","per":"{}","purpose":{},"groups":{},"pairs":{},"ranks":{},)"
                     R"("bootstrap":{{"resamples":{},"seed":{}}},"notes":{}}})",
                     name_of(comparison.options.by), name_of(comparison.unit),
                     json_text(comparison.options.choice.purpose),
                     list(comparison.groups, group_json), list(comparison.pairs, pair_json),
                     list(comparison.ranks, ranks_json), kResamples, kBootstrapSeed,
                     list(comparison.notes, json_text));
}

}  // namespace swarmsmith::cli
