#include "cli/commands/comparison_json.h"

#include "analysis/comparison/comparison_tables.h"
#include "analysis/statistics/effect_size.h"
#include "base/text/json.h"

namespace swarmsmith::cli {
namespace {

JsonObject group_json(const ComparedGroup& group) {
  const Summary& summary = group.summary;
  return JsonObject()
      .add("mission", group.mission)
      .add("method", group.method)
      .add("source", group.source)
      .add("n", summary.n)
      .add("designs", group.designs)
      .add("runs", group.runs)
      .add("mean", summary.mean)
      .add("sd", summary.sd)
      .add("min", summary.least)
      .add("lower_quartile", summary.lower_quartile)
      .add("median", summary.median)
      .add("upper_quartile", summary.upper_quartile)
      .add("max", summary.most);
}

JsonObject pair_json(const ComparedPair& pair) {
  return JsonObject()
      .add("mission", pair.mission)
      .add("method", pair.method)
      .add("source", pair.source)
      .add("first", pair.first)
      .add("second", pair.second)
      .add("n_first", pair.n_first)
      .add("n_second", pair.n_second)
      .add("test", pair.paired ? "signed-rank" : "rank-sum")
      .add("statistic", pair.test.statistic)
      .add("p", pair.test.p_value)
      .add("p_holm", pair.p_holm)
      .add("p_method", method_of(pair.test))
      .add("zeros", pair.test.zeros)
      .add("least_p", pair.test.least_p)
      .add("a12", pair.a12)
      .add("magnitude", magnitude_of(pair.a12))
      .add("mean_difference", pair.difference.value)
      .add("difference_low", pair.difference.low)
      .add("difference_high", pair.difference.high)
      .add("notes", pair.notes);
}

JsonObject ranks_json(const ComparedRanks& ranks) {
  const FriedmanTest& test = ranks.test;
  return JsonObject()
      .add("source", ranks.source)
      .add("names", ranks.names)
      .add("mean_ranks", test.mean_ranks)
      .add("half_width", test.half_width)
      .add("chi_squared", test.statistic)
      .add("degrees", test.degrees)
      .add("p", test.p_value)
      .add("blocks", test.blocks)
      .add("incomplete", ranks.incomplete)
      .add("missions", ranks.missions);
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  return JsonObject()
      .add("by", name_of(comparison.options.by))
      .add("per", name_of(comparison.unit))
      .add("purpose", comparison.options.choice.purpose)
      .add("groups", json_list(comparison.groups, group_json))
      .add("pairs", json_list(comparison.pairs, pair_json))
      .add("ranks", json_list(comparison.ranks, ranks_json))
      .add("bootstrap", JsonObject().add("resamples", kResamples).add("seed", kBootstrapSeed))
      .add("notes", comparison.notes)
      .text();
}

}  // namespace swarmsmith::cli
