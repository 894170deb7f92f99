#include <algorithm>
#include <memory>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/comparison/comparison_text.h"
#include "analysis/comparison/method_matrix.h"
#include "analysis/comparison/paper_text.h"
#include "analysis/statistics/effect_size.h"
#include "base/text/json.h"
#include "cli/arguments/score_words.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/replay/design_worlds.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

struct CompareArguments {
  StoreArgument store;
  std::string by;
  std::string purpose;
  std::string per;
  std::string table;
  std::string paper;
  bool csv = false;
  bool matrix = false;
  ComparisonOptions options;

  bool is_matrix() const { return matrix || table == "matrix"; }
};

CompareBy by_of(const std::string& word) {
  if (word == "method") return CompareBy::Method;
  return word == "mission" ? CompareBy::Mission : CompareBy::Source;
}

std::string csv_of(const Comparison& comparison, const std::string& table) {
  if (table == "groups") return groups_csv(comparison);
  if (table == "ranks") return ranks_csv(comparison.ranks);
  if (table == "matrix") return matrices_csv(comparison);
  return pairs_csv(comparison);
}

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

std::string matrix_json(const Comparison& comparison) {
  return JsonObject()
      .add("per", name_of(comparison.unit))
      .add("purpose", comparison.options.choice.purpose)
      .add("matrices", matrices_json(comparison))
      .add("notes", matrix_notes(comparison))
      .text();
}

/// Compares as the arguments say; by default by source if there are several sources, else by
/// method.
Expected<Comparison> compared_by(StoreReader& store, const CompareArguments& arguments) {
  ComparisonOptions options = arguments.options;
  options.by = arguments.is_matrix() ? CompareBy::Method : by_of(arguments.by);
  options.choice = score_choice(arguments.purpose, arguments.per);
  auto comparison = compare(store, options);
  if (!comparison || !arguments.by.empty() || options.by != CompareBy::Source) return comparison;
  const auto differ = [&](std::string ComparedGroup::*part) {
    return std::ranges::any_of(comparison->groups, [&](const ComparedGroup& group) {
      return group.*part != comparison->groups.front().*part;
    });
  };
  if (differ(&ComparedGroup::source) || !differ(&ComparedGroup::method)) return comparison;
  options.by = CompareBy::Method;
  return compare(store, options);
}

/// The comparison, with notes on missions and profiles that share a name but differ.
Expected<Comparison> compared(StoreReader& store, const CompareArguments& arguments) {
  auto comparison = compared_by(store, arguments);
  if (!comparison) return comparison;
  if (const auto worlds = DesignWorlds::read(store)) {
    for (std::string& sentence : worlds->mixed_names())
      comparison->notes.push_back(std::move(sentence));
  }
  return comparison;
}

ExitCode run_compare(CompareArguments& arguments, Output& output) {
  if (!arguments.table.empty() && !arguments.csv)
    return fail(output, ExitCode::Usage, "--table says which table --csv writes: give both");
  if (!arguments.paper.empty() && (arguments.csv || output.json))
    return fail(output, ExitCode::Usage, "--paper writes sentences: leave --csv and --json out");
  if (arguments.matrix && (arguments.csv || !arguments.paper.empty()))
    return fail(output, ExitCode::Usage,
                "--matrix is for people and --json; as a table it is --csv --table matrix");
  if (arguments.is_matrix() && !arguments.by.empty() && arguments.by != "method")
    return fail(output, ExitCode::Usage, "a matrix compares methods: leave --by out");
  const auto store = arguments.store.open_whole();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const auto comparison = compared(**store, arguments);
  if (!comparison) {
    const bool not_there = comparison.error().kind == ErrorKind::NotFound;
    return fail(output, not_there ? ExitCode::NoSuchId : ExitCode::Usage, comparison.error());
  }
  if (!arguments.paper.empty()) {
    for (const PaperSentence& sentence : paper_sentences(*comparison))
      output.out << (arguments.paper == "latex" ? sentence.latex : sentence.text) << "\n";
    for (const std::string& note : comparison->notes)
      print_note(output, note);
  } else if (arguments.csv) {
    // A comparison by mission has no pairs.
    const bool groups = arguments.table.empty() && comparison->options.by == CompareBy::Mission;
    write_data(output, csv_of(*comparison, groups ? "groups" : arguments.table));
    for (const std::string& note : comparison->notes)
      print_note(output, note);
  } else if (output.json) {
    output.out << (arguments.matrix ? matrix_json(*comparison) : comparison_json(*comparison))
               << "\n";
  } else {
    output.out << (arguments.matrix ? matrices_text(*comparison) : comparison_text(*comparison));
  }
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_compare(Options& options) {
  auto arguments = std::make_shared<CompareArguments>();
  arguments->store.declare(options);
  options.choice("--by", arguments->by, {"source", "method", "mission"},
                 "What to compare (default: source if there are several, else method)");
  options.flag("--matrix", arguments->matrix,
               "Which method wins where, by how much, and how certainly: methods by missions");
  options.texts("--mission MISSION", arguments->options.missions, "Only this mission; repeatable");
  options.text("--method METHOD", arguments->options.method, "Only this method");
  options.text("--source SOURCE", arguments->options.source, "Only scores of this source");
  options.choice("--purpose", arguments->purpose, {"test", "score", "all"}, kPurposeHelp);
  options.choice("--per", arguments->per, {"run", "design"}, kPerHelp);
  options.flag("--csv", arguments->csv, "Write CSV: a header, full precision");
  options.choice("--table", arguments->table, {"groups", "pairs", "ranks", "matrix"},
                 "Table for --csv (default pairs; by mission groups)");
  options.choice("--paper", arguments->paper, {"text", "latex"},
                 "Write sentences for a paper: n, means, test, p, effect, interval");
  return [arguments](Output& output) { return run_compare(*arguments, output); };
}

}  // namespace swarmsmith::cli
