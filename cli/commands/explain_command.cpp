#include <memory>
#include <optional>

#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/commands/explain_design.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

struct ExplainArguments {
  std::string id;
  StoreArgument store;
};

/// Everything that the store knows of one evaluation, the outcome last.
struct History {
  Rows candidate;
  Rows evaluation;  ///< none while it has no outcome
  Rows steps;       ///< of the race, in which it counted
  Rows attempts;    ///< leases that did not simply end with the result
  Rows failures;
  Rows conflicts;
  Rows worker;  ///< who gave the outcome
  StoredStages stages{};
  std::string design{};

  /// Races have other words than searches without tests.
  bool is_race() const {
    const SearchOptions* search = stages.search(design);
    return search == nullptr || words_of(search->kind).has_tests;
  }
};

/// The text of a column of the first row; empty when it is null or there is no row.
std::string cell(const Rows& rows, const std::string& column) {
  for (std::size_t i = 0; i < rows.columns.size() && !rows.cells.empty(); ++i) {
    if (rows.columns[i] == column) return rows.cells.front()[i].text;
  }
  return {};
}

Expected<History> read_history(StoreReader& store, const ThingId& id) {
  const std::string candidate = id.digits + " / 100000";
  const std::string pair = id.digits + " % 100000";
  const std::string is_it = is_evaluation(id);
  const std::string design = "(" + candidate + " - 1) / 1000000 + 1";
  History history;
  const std::pair<std::string, Rows*> parts[] = {
      {"SELECT candidate, design, iteration, parent, fsm_config, parameters, eliminated_in, "
       "eliminated_at, eliminated_by FROM v_candidates WHERE candidate = " +
           candidate,
       &history.candidate},
      {"SELECT * FROM v_evaluations WHERE " + is_it, &history.evaluation},
      {"SELECT m.iteration, m.step, m.rank, s.marker, s.alive_before, s.alive_after FROM "
       "v_race_matrix AS m JOIN v_race_steps AS s ON s.design = m.design AND s.step = m.step "
       "WHERE m.design = " +
           design + " AND m.candidate = " + candidate + " AND m.pair = " + pair +
           (id.purpose.empty() ? "" : " AND 0") + " ORDER BY m.step",
       &history.steps},
      {"SELECT at, attempt, worker, host, held_ms, outcome FROM v_attempts WHERE " + is_it +
           " ORDER BY at, attempt",
       &history.attempts},
      {"SELECT at, attempt, worker, host, reason, command, output, errors FROM v_failures WHERE " +
           is_it + " AND at IS NOT NULL ORDER BY at",
       &history.failures},
      {"SELECT time AS at, kept_score, other_score, other_worker FROM conflict WHERE candidate = " +
           candidate + " AND pair = " + pair + " AND purpose = " +
           (id.purpose.empty() ? "0" : std::to_string(1 + std::string("ltasvp").find(id.purpose))) +
           " ORDER BY time",
       &history.conflicts},
      {"SELECT w.worker, w.host, w.pid, w.job, w.client, w.build, w.state FROM v_workers AS w "
       "WHERE "
       "w.worker = (SELECT worker FROM v_evaluations WHERE " +
           is_it + ")",
       &history.worker}};
  for (const auto& [sql, rows] : parts) {
    auto found = select(store, sql);
    if (!found) return Unexpected(found.error());
    *rows = std::move(*found);
  }
  auto stages = StoredStages::read(store);
  if (!stages) return Unexpected(stages.error());
  history.stages = std::move(*stages);
  history.design = to_string(design_of_thing(id));
  letter_ids(history.candidate);
  letter_ids(history.evaluation);
  return history;
}

std::string why(const History& history) {
  const std::string purpose = cell(history.evaluation, "purpose");
  if (purpose == "transfer") return "a test of its candidate under a further profile";
  if (purpose == "test")
    return history.is_race() ? "a test of its candidate after the race, outside of the budget"
                             : "a test of its candidate after the search, outside of the budget";
  if (purpose == "audit") return "an audit: a second worker, bits compared";
  if (purpose == "score") return "a person scored the candidate";
  if (purpose == "evaluator") return "a call of the targetEvaluator";
  const std::string iteration = cell(history.evaluation, "iteration");
  if (iteration.empty()) return "looked ahead: no race has wanted it";
  const std::string step = cell(history.steps, "step");
  const std::string part = history.stages.round(history.design, iteration);
  return (history.is_race() ? "the race of " + ("iteration " + iteration) : part) +
         (step.empty() ? "" : ", first in step " + step);
}

std::string used(const History& history) {
  const std::string iteration = cell(history.evaluation, "iteration");
  if (cell(history.evaluation, "purpose") != "race")
    return history.is_race() ? "not by the race" : "not by the search";
  if (history.steps.cells.empty()) {
    return iteration.empty() ? "no" : "not in a step that is over";
  }
  return "in " + std::to_string(history.steps.cells.size()) + " step" +
         (history.steps.cells.size() == 1 ? "" : "s") +
         (history.is_race() ? " of the race" : " of the search");
}

void write_line(Output& output, const char* name, const std::string& value) {
  if (!value.empty())
    output.out << name << std::string(12 - std::string(name).size(), ' ')
               << as_shown(value, Layout::Escaped) << "\n";
}

void write_outcome(Output& output, const std::string& id, const History& history) {
  const Rows& evaluation = history.evaluation;
  write_line(output, "asked for", why(history));
  write_line(output, "pair",
             cell(evaluation, "pair") + ", instance " + cell(evaluation, "instance") + ", seed " +
                 cell(evaluation, "seed"));
  const std::string score = cell(evaluation, "score");
  write_line(output, "outcome",
             cell(evaluation, "status") + (score.empty() ? "" : ", score " + score) + ", attempt " +
                 cell(evaluation, "attempt") + ", " + cell(evaluation, "wall_ms") + " ms");
  const Rows& worker = history.worker;
  if (!worker.cells.empty()) {
    const std::string job = cell(worker, "job");
    const std::string client = cell(worker, "client");
    write_line(output, "worker",
               cell(worker, "worker") + " on " + cell(worker, "host") + ", pid " +
                   cell(worker, "pid") + (job.empty() ? "" : ", job " + job) +
                   (client.empty() ? "" : ", key " + client) + ", build " + cell(worker, "build") +
                   " (" + cell(worker, "state") + ")");
  }
  write_line(output, "used", used(history));
  write_line(output, "replay", "swarmsmith replay " + id + " STORE");
}

/// What control software it is, by how its text begins.
const char* name_of_text(const std::string& text) {
  if (text.starts_with("--network")) return "network";
  if (text.starts_with("--nroot") || text.starts_with("--bt-config")) return "tree";
  return "machine";
}

/// The steps as people read them: without tests nothing is marked, and nobody leaves.
Rows told_steps(const History& history) {
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

void write_text(Output& output, const std::string& id, const History& history) {
  output.out << "evaluation " << id << "\n";
  const Rows& candidate = history.candidate;
  write_line(output, "candidate",
             cell(candidate, "candidate") + " of " + cell(candidate, "design") + ", made in " +
                 history.stages.round(history.design, cell(candidate, "iteration")));
  const std::string text = cell(candidate, "fsm_config");
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

/// Objects or null for what there is one of, arrays for the rest.
void write_json(Output& output, const std::string& id, const History& history) {
  const auto one = [](const Rows& rows) {
    return rows.cells.empty() ? std::nullopt : std::optional(row_as_json(rows, 0));
  };
  const bool has_outcome = !history.evaluation.cells.empty();
  output.out << JsonObject()
                    .add("v", 1)
                    .add("id", id)
                    .add("candidate", one(history.candidate))
                    .add("evaluation", one(history.evaluation))
                    .add("asked_for", has_outcome ? std::optional(why(history)) : std::nullopt)
                    .add("worker", one(history.worker))
                    .add("steps", rows_as_json(history.steps))
                    .add("attempts", rows_as_json(history.attempts))
                    .add("failures", rows_as_json(history.failures))
                    .add("conflicts", rows_as_json(history.conflicts))
                    .text()
             << "\n";
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
  if (id->letter == 'd') return explain_design(output, **store, *id);
  const auto history = read_history(**store, *id);
  if (!history) return fail(output, ExitCode::Store, history.error());
  const bool is_known = !history->evaluation.cells.empty() || !history->attempts.cells.empty() ||
                        !history->failures.cells.empty();
  if (!is_known) {
    return fail(output, ExitCode::NoSuchId, "the store has no " + arguments.id);
  }
  output.json ? write_json(output, arguments.id, *history)
              : write_text(output, arguments.id, *history);
  return ExitCode::Done;
}

}  // namespace

Run declare_explain(Options& options) {
  auto arguments = std::make_shared<ExplainArguments>();
  options.text("EVALUATION", arguments->id, "e100000007, e100000007t of a test, or a design: d3",
               Options::Need::Required);
  arguments->store.declare(options);
  return [arguments](Output& output) { return run_explain(*arguments, output); };
}

}  // namespace swarmsmith::cli
