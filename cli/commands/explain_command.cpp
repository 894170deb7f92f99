#include <memory>
#include <optional>

#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/commands/explain_design.h"
#include "cli/output/evaluation_history.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

struct ExplainArguments {
  std::string id;
  StoreArgument store;
};

std::string used(const EvaluationHistory& history) {
  const std::string iteration = cell_text(history.evaluation, "iteration");
  if (cell_text(history.evaluation, "purpose") != "race")
    return history.is_race() ? "not by the race" : "not by the search";
  if (history.steps.cells.empty()) {
    return iteration.empty() ? "no" : "not in a step that is over";
  }
  return "in " + counted(history.steps.cells.size(), "step") +
         (history.is_race() ? " of the race" : " of the search");
}

void write_line(Output& output, const char* name, const std::string& value) {
  if (!value.empty())
    output.out << name << std::string(12 - std::string(name).size(), ' ')
               << as_shown(value, Layout::Escaped) << "\n";
}

void write_outcome(Output& output, const std::string& id, const EvaluationHistory& history) {
  const Rows& evaluation = history.evaluation;
  write_line(output, "asked for", why(history));
  write_line(output, "pair",
             cell_text(evaluation, "pair") + ", instance " + cell_text(evaluation, "instance") +
                 ", seed " + cell_text(evaluation, "seed"));
  const std::string score = cell_text(evaluation, "score");
  write_line(output, "outcome",
             cell_text(evaluation, "status") + (score.empty() ? "" : ", score " + score) +
                 ", attempt " + cell_text(evaluation, "attempt") + ", " +
                 cell_text(evaluation, "wall_ms") + " ms");
  const Rows& worker = history.worker;
  if (!worker.cells.empty()) {
    const std::string job = cell_text(worker, "job");
    const std::string client = cell_text(worker, "client");
    write_line(output, "worker",
               cell_text(worker, "worker") + " on " + cell_text(worker, "host") + ", pid " +
                   cell_text(worker, "pid") + (job.empty() ? "" : ", job " + job) +
                   (client.empty() ? "" : ", key " + client) + ", build " +
                   cell_text(worker, "build") + " (" + cell_text(worker, "state") + ")");
  }
  write_line(output, "used", used(history));
  write_line(output, "replay", "swarmsmith replay " + id + " STORE");
}

/// The kind of control software, from the beginning of its text.
const char* name_of_text(const std::string& text) {
  if (text.starts_with("--network")) return "network";
  if (text.starts_with("--nroot") || text.starts_with("--bt-config")) return "tree";
  return "machine";
}

/// The steps as people read them: without tests, no elimination is shown.
Rows told_steps(const EvaluationHistory& history) {
  Rows steps = history.steps;
  if (history.is_race()) return steps;
  for (const char* column : {"marker", "alive_before", "alive_after"})
    remove_column(steps, column);
  rename_column(steps, "iteration", "stage");
  for (auto& cells : steps.cells)
    cells.front() = {StoreReader::Cell::Type::Text,
                     history.stages.round(history.design, cells.front().text)};
  return steps;
}

void write_text(Output& output, const std::string& id, const EvaluationHistory& history) {
  output.out << "evaluation " << id << "\n";
  const Rows& candidate = history.candidate;
  write_line(output, "candidate",
             cell_text(candidate, "candidate") + " of " + cell_text(candidate, "design") +
                 ", made in " +
                 history.stages.round(history.design, cell_text(candidate, "iteration")));
  const std::string text = cell_text(candidate, "fsm_config");
  write_line(output, name_of_text(text), text);
  if (history.evaluation.cells.empty()) {
    write_line(output, "outcome", "none yet");
  } else {
    write_outcome(output, id, history);
  }
  const Rows steps = told_steps(history);
  const std::pair<const char*, const Rows*> tables[] = {{"steps", &steps},
                                                        {"attempts", &history.attempts},
                                                        {"failures", &history.failures},
                                                        {"conflicts", &history.conflicts}};
  for (const auto& [name, rows] : tables) {
    if (!rows->cells.empty()) output.out << "\n" << name << "\n" << rows_as_text(*rows);
  }
}

ExitCode run_explain(const ExplainArguments& arguments, Output& output) {
  const auto id = parse_thing_id(arguments.id);
  if (!id || (id->letter != 'e' && id->letter != 'd')) {
    return fail(output, ExitCode::Usage,
                "\"" + arguments.id +
                    "\" is not the id of an evaluation, such as e100000007, or of a design, such "
                    "as d3");
  }
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  if (id->letter == 'd')
    return explain_design(output, **store, *id, has_writer(*arguments.store.path()));
  const auto history = read_history(**store, *id);
  if (!history) return fail(output, ExitCode::Store, history.error());
  if (!history->is_known()) {
    return fail(output, ExitCode::NoSuchId, "the store has no " + arguments.id);
  }
  if (!output.json) {
    write_text(output, arguments.id, *history);
  } else {
    output.out << history_as_json(arguments.id, *history).text() << "\n";
  }
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_explain(Options& options) {
  auto arguments = std::make_shared<ExplainArguments>();
  options.text("EVALUATION DESIGN", arguments->id,
               "e100000007, e100000007t of a test, or a design: d3", Options::Need::Required);
  arguments->store.declare(options);
  return [arguments](Output& output) { return run_explain(*arguments, output); };
}

}  // namespace swarmsmith::cli
