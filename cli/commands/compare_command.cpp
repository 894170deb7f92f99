#include <memory>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/comparison/comparison_text.h"
#include "analysis/comparison/paper_text.h"
#include "cli/arguments/score_words.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/commands/comparison_json.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

struct CompareArguments {
  StoreArgument store;
  std::string by = "source";
  std::string purpose;
  std::string per;
  std::string table;
  std::string paper;
  bool csv = false;
  ComparisonOptions options;
};

CompareBy by_of(const std::string& word) {
  if (word == "method") return CompareBy::Method;
  return word == "mission" ? CompareBy::Mission : CompareBy::Source;
}

std::string csv_of(const Comparison& comparison, const std::string& table) {
  if (table == "groups") return groups_csv(comparison);
  if (table == "ranks") return ranks_csv(comparison.ranks);
  return pairs_csv(comparison);
}

ExitCode run_compare(CompareArguments& arguments, Output& output) {
  if (!arguments.table.empty() && !arguments.csv)
    return fail(output, ExitCode::Usage, "--table says which table --csv writes: give both");
  if (!arguments.paper.empty() && (arguments.csv || output.json))
    return fail(output, ExitCode::Usage, "--paper writes sentences: leave --csv and --json out");
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  arguments.options.by = by_of(arguments.by);
  arguments.options.choice = score_choice(arguments.purpose, arguments.per);
  const auto comparison = compare(**store, arguments.options);
  if (!comparison) {
    const bool not_there = comparison.error().kind == ErrorKind::NotFound;
    return fail(output, not_there ? ExitCode::NoSuchId : ExitCode::Usage, comparison.error());
  }
  if (!arguments.paper.empty()) {
    for (const PaperSentence& sentence : paper_sentences(*comparison))
      output.out << (arguments.paper == "latex" ? sentence.latex : sentence.text) << "\n";
  } else if (arguments.csv) {
    // By mission there are no pairs.
    const bool groups = arguments.table.empty() && comparison->options.by == CompareBy::Mission;
    write_data(output, csv_of(*comparison, groups ? "groups" : arguments.table));
    for (const std::string& note : comparison->notes)
      print_note(output, note);
  } else {
    output.out << (output.json ? comparison_json(*comparison) + "\n"
                               : comparison_text(*comparison));
  }
  return ExitCode::Done;
}

}  // namespace

Run declare_compare(Options& options) {
  auto arguments = std::make_shared<CompareArguments>();
  arguments->store.declare(options);
  options.choice("--by", arguments->by, {"source", "method", "mission"},
                 "What to compare (default source)");
  options.texts("--mission", arguments->options.missions, "Only this mission; repeatable");
  options.text("--method", arguments->options.method, "Only this method");
  options.text("--source", arguments->options.source, "Only scores of this source");
  options.choice("--purpose", arguments->purpose, {"test", "score", "all"}, kPurposeHelp);
  options.choice("--per", arguments->per, {"run", "design"}, kPerHelp);
  options.flag("--csv", arguments->csv, "Write CSV: a header, full precision");
  options.choice("--table", arguments->table, {"groups", "pairs", "ranks"},
                 "Table for --csv (default pairs; by mission groups)");
  options.choice("--paper", arguments->paper, {"text", "latex"},
                 "Write sentences for a paper: n, means, test, p, effect, interval");
  return [arguments](Output& output) { return run_compare(*arguments, output); };
}

}  // namespace swarmsmith::cli
