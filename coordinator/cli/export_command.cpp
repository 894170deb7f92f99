#include <fstream>
#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/export_irace.h"
#include "coordinator/cli/query_output.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  StoreArgument store;
  std::string what = "best";
  std::string format = "fsm-config";
  std::string file;
  IraceExport irace;
};

/// Machines with what a person wants to know of each; `selected` gives (design, candidate).
std::string statement(const std::string& what) {
  std::string selected =
      "SELECT design, best_candidate AS candidate FROM v_designs "
      "WHERE best_candidate IS NOT NULL";
  if (what == "elites") {
    selected =
        "SELECT design, candidate FROM v_convergence AS e WHERE iteration = "
        "(SELECT max(iteration) FROM v_convergence AS l WHERE l.design = e.design)";
  }
  if (what == "all") selected = "SELECT design, candidate FROM v_candidates";
  return "SELECT s.design, d.mission, d.method, d.repetition, s.candidate, c.iteration, c.mean, "
         "c.runs, c.fsm_config, c.parameters, c.modules FROM (" +
         selected +
         ") AS s JOIN v_designs AS d ON d.design = s.design "
         "JOIN v_candidates AS c ON c.candidate = s.candidate ORDER BY s.design, s.candidate";
}

enum Column {
  kDesign,
  kMission,
  kMethod,
  kRepetition,
  kCandidate,
  kIteration,
  kMean,
  kRuns,
  kText,
  kParameters,
  kModules
};

/// A comment line with where the machine comes from, then its text; of a configuration of a
/// parameter file its switches and values.
std::string as_fsm_config(const Rows& rows) {
  std::string text;
  for (const auto& cells : rows.cells) {
    text += "# " + cells[kDesign].text + " " + cells[kMission].text + " " + cells[kMethod].text +
            " repetition " + cells[kRepetition].text + ": " + cells[kCandidate].text;
    if (!cells[kMean].text.empty()) {
      text += ", mean " + cells[kMean].text + " over " + cells[kRuns].text + " runs";
    }
    const bool is_machine = cells[kModules].text != "{}";
    text += std::string("\n") + (is_machine ? "--fsm-config " : "") + cells[kText].text + "\n";
  }
  return text;
}

/// With parameters and modules, which are JSON already.
std::string as_json(const Rows& rows) {
  std::string text = "{\"machines\":[";
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    const auto& cells = rows.cells[i];
    if (i > 0) text += ",";
    Rows plain{.columns = {rows.columns.begin(), rows.columns.begin() + kParameters},
               .cells = {{cells.begin(), cells.begin() + kParameters}},
               .truncated = false};
    std::string object = row_as_json(plain, 0);
    object.pop_back();
    // These two are JSON objects in the store.
    const auto object_or_empty = [](const std::string& json) { return json.empty() ? "{}" : json; };
    text += object + ",\"parameters\":" + object_or_empty(cells[kParameters].text) +
            ",\"modules\":" + object_or_empty(cells[kModules].text) + "}";
  }
  return text + "]}\n";
}

ExitCode run(const Arguments& arguments, Output& output) {
  if (arguments.format == "irace") {
    const auto source = arguments.store.path();
    if (!source) return fail(output, ExitCode::Usage, source.error());
    return export_irace(*source, arguments.irace, arguments.file, output);
  }
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  auto rows = select(**store, statement(arguments.what), {.rows = 1'000'000'000, .seconds = 600});
  if (!rows) return fail(output, ExitCode::Store, rows.error());
  if (rows->cells.empty()) print_note(output, "the store has no such machines yet");
  letter_ids(*rows);
  const bool json = output.json || arguments.format == "json";
  const std::string text = json ? as_json(*rows) : as_fsm_config(*rows);
  if (arguments.file.empty()) {
    output.out << text;
    return ExitCode::Done;
  }
  std::ofstream stream(arguments.file, std::ios::binary);
  stream << text;
  stream.close();
  if (stream) return ExitCode::Done;
  return fail(output, ExitCode::Failed, cannot_write(arguments.file));
}

}  // namespace

Run declare_export(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  arguments->store.declare(options);
  options.choice("--what", arguments->what, {"best", "elites", "all"},
                 "Each design's best machine, its last elites, or every candidate");
  options.choice(
      "--format", arguments->format, {"fsm-config", "json", "irace"},
      "Text of the grammar with comment lines, JSON, or a folder in which R's irace does "
      "the same design");
  options.text("-o,--output", arguments->file, "Write to this file, or folder");
  options.text("--design", arguments->irace.design,
               "With --format irace: which design (default: d1, when they differ in repetition "
               "alone)");
  options.choice("--irace", arguments->irace.version, {"3.5", "4"},
                 "With --format irace: the irace that reads the files (default 4)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
