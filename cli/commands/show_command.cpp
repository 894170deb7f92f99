#include <algorithm>
#include <memory>

#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_campaigns.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

struct ShowArguments {
  std::string id;
  StoreArgument store;
};

/// A part of the output: its name in JSON and as a headline, and its rows.
struct Part {
  std::string name;
  std::string sql;
};

/// The scores of a design's winner from outside its race, by source. Before schema 4, all of them
/// were tests.
std::string scores_of(const std::string& number, const std::string& purpose, bool has_purposes) {
  const std::string of = has_purposes ? " AND purpose = '" + purpose + "'" : "";
  return "SELECT candidate, source, count(score) AS runs, avg(score) AS mean, "
         "min(score) AS lowest, max(score) AS highest FROM v_design_scores "
         "WHERE design = " +
         number + of + " GROUP BY candidate, source";
}

/// Statements that show a thing; the first statement returns one row if the thing exists.
std::vector<Part> parts_of_design(const std::string& number, bool has_purposes) {
  std::vector<Part> parts = {
      {"design", "SELECT * FROM v_designs WHERE design = " + number},
      {"elites",
       "SELECT iteration, rank, candidate, mean, n, experiments_used "
       "FROM v_convergence WHERE design = " +
           number + " ORDER BY iteration, rank"},
      {"test", scores_of(number, "test", has_purposes)},
      {"commands", "SELECT number, kind, budget, step, who, at FROM v_commands WHERE design = " +
                       number + " ORDER BY number"}};
  if (has_purposes) parts.push_back({"scores", scores_of(number, "score", true)});
  return parts;
}

std::vector<Part> parts_of_candidate(const std::string& number) {
  return {{"candidate", "SELECT * FROM v_candidates WHERE candidate = " + number},
          {"ancestry",
           "WITH RECURSIVE line (candidate, parent, iteration, mean, depth) AS ("
           "SELECT candidate, parent, iteration, mean, 0 FROM v_candidates WHERE candidate = " +
               number +
               " UNION ALL SELECT c.candidate, c.parent, c.iteration, c.mean, depth + 1 "
               "FROM line JOIN v_candidates AS c ON c.candidate = line.parent) "
               "SELECT candidate, parent, iteration, mean FROM line WHERE depth > 0"},
          {"scores",
           "SELECT purpose, source, count(score) AS runs, avg(score) AS mean, "
           "min(score) AS lowest, max(score) AS highest FROM v_evaluations "
           "WHERE candidate = " +
               number + " GROUP BY purpose, source"}};
}

std::vector<Part> parts_of_evaluation(const ThingId& id) {
  return {{"evaluation", "SELECT * FROM v_evaluations WHERE " + is_evaluation(id)}};
}

/// Older stores have no logs of robots.
constexpr std::int64_t kSchemaOfLogs = 10;
/// Older stores have no checks of runs.
constexpr std::int64_t kSchemaOfChecks = 13;
constexpr std::string_view kChecks = "checks";

std::vector<Part> parts_of_real_run(const std::string& number, std::int64_t schema) {
  const std::string of_run = " WHERE run = " + number;
  std::vector<Part> parts = {
      {"real run", "SELECT * FROM v_real_runs" + of_run},
      {"robots",
       "SELECT robot, name, tag, measured, interpolated, degraded, missing, longest_gap_s, "
       "outliers, sigma_m, border_m, too_close FROM v_real_robots" +
           of_run + " ORDER BY robot"},
      {"issues",
       "SELECT code, robot, from_s, to_s, text FROM v_real_issues" + of_run + " ORDER BY number"},
      {"scorings", "SELECT scoring, score, verdict, biased, at, program FROM v_real_scores" +
                       of_run + " ORDER BY scoring"},
      {"overrides", "SELECT scoring, verdict, who, reason, at FROM v_real_overrides" + of_run +
                        " ORDER BY number"},
      {"videos", "SELECT camera, file, frames, damaged_frames, time_source FROM v_real_videos" +
                     of_run + " ORDER BY video"},
      {"calibrations",
       "SELECT kind, subject, valid_from, valid_until, rms FROM v_calibrations WHERE sha256 IN "
       "(SELECT camera_calibration FROM v_real_videos" +
           of_run + " UNION SELECT place_calibration FROM v_real_videos" + of_run +
           " UNION SELECT offset_calibration FROM v_real_robots" + of_run +
           ") ORDER BY kind, subject"}};
  if (schema >= kSchemaOfLogs) {
    parts.push_back({"logs of robots",
                     "SELECT name, verdict, stepped, held, skipped, clock_offset_s, latency_s, "
                     "latency_error_s, latency_reason FROM v_real_logs" +
                         of_run + " ORDER BY robot"});
  }
  parts.push_back({std::string(kChecks),
                   schema >= kSchemaOfChecks
                       ? "SELECT outcome, name, subject, value, bound, unit, catches, reason FROM "
                         "v_real_checks" +
                             of_run +
                             " ORDER BY outcome <> 'failed', outcome <> 'warned', "
                             "outcome <> 'not run', number"
                       : "SELECT 1 WHERE 0"});
  return parts;
}

std::vector<Part> parts_of(const ThingId& id, bool has_purposes, std::int64_t schema) {
  if (id.letter == 'd') return parts_of_design(id.digits, has_purposes);
  if (id.letter == 'c') return parts_of_candidate(id.digits);
  if (id.letter == 'r') return parts_of_real_run(id.digits, schema);
  return parts_of_evaluation(id);
}

/// One row as "name  value" lines.
std::string as_lines(const Rows& rows) {
  std::size_t width = 0;
  for (const std::string& column : rows.columns)
    width = std::max(width, column.size());
  std::string text;
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    const auto& cell = rows.cells.front()[column];
    if (cell.type == StoreReader::Cell::Type::Null || cell.text.empty()) continue;
    const std::string& name = rows.columns[column];
    text += name + std::string(width - name.size() + 2, ' ') +
            as_shown(cell.text, Layout::Escaped) + "\n";
  }
  return text;
}

/// The thing itself as lines, the other parts as tables.
void write_text(Output& output, const std::vector<Part>& parts, const std::vector<Rows>& rows) {
  output.out << as_lines(rows.front());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].name == kChecks && rows[i].cells.empty())
      output.out << "\nchecks\nnot recorded: an older version scored this run; `swarmsmith track "
                    "rescore` scores it again\n";
    if (rows[i].cells.empty()) continue;
    output.out << "\n" << parts[i].name << "\n" << rows_as_text(rows[i]);
  }
}

/// One object with one key per part.
void write_json(Output& output, const std::vector<Part>& parts, const std::vector<Rows>& rows) {
  JsonObject object;
  object.add(parts.front().name, row_as_json(rows.front(), 0));
  for (std::size_t i = 1; i < parts.size(); ++i)
    object.add(parts[i].name, rows_as_json(rows[i]));
  output.out << object.text() << "\n";
}

/// Replaces the numbers of iterations if the search does not have iterations.
void tell_rounds(Rows& rows, const StoredStages& stages, const ThingId& id) {
  const std::string design = to_string(design_of_thing(id));
  const SearchOptions* search = stages.search(design);
  const auto column = std::ranges::find(rows.columns, "iteration");
  if (search == nullptr || column == rows.columns.end()) return;
  if (std::ranges::find(rows.columns, "budget") != rows.columns.end()) return stages.tell(rows);
  const auto place = static_cast<std::size_t>(column - rows.columns.begin());
  *column = "stage";
  for (auto& cells : rows.cells) {
    if (!cells[place].text.empty())
      cells[place] = {StoreReader::Cell::Type::Text, stages.round(design, cells[place].text)};
  }
}

ExitCode run_show(const ShowArguments& arguments, Output& output) {
  const auto id = parse_thing_id(arguments.id);
  if (!id) {
    return fail(output, ExitCode::Usage,
                "\"" + arguments.id +
                    "\" is not an id; ids look like d3 (design), c812 (candidate), " +
                    "e81200007 (evaluation), r7 (real run)");
  }
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const auto known = select(**store, "SELECT * FROM v_design_scores LIMIT 0");
  if (!known) return fail(output, ExitCode::Store, known.error());
  const bool has_purposes = std::ranges::find(known->columns, "purpose") != known->columns.end();
  const auto stages = StoredStages::read(**store);
  if (!stages) return fail(output, ExitCode::Store, stages.error());
  const std::vector<Part> parts = parts_of(*id, has_purposes, (*store)->schema());
  std::vector<Rows> shown;
  for (const Part& part : parts) {
    auto rows = select(**store, part.sql);
    if (!rows) return fail(output, ExitCode::Store, rows.error());
    if (shown.empty() && rows->cells.empty()) {
      return fail(output, ExitCode::NoSuchId, "the store has no " + part.name + " " + arguments.id);
    }
    letter_ids(*rows);
    if (part.name == "design") mark_interrupted(*rows, has_writer(*arguments.store.path()));
    if (!output.json) tell_rounds(*rows, *stages, *id);
    if (!output.json && is_of_programs(**store)) as_costs(*rows);
    shown.push_back(std::move(*rows));
  }
  output.json ? write_json(output, parts, shown) : write_text(output, parts, shown);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_show(Options& options) {
  auto arguments = std::make_shared<ShowArguments>();
  options.text("ID DESIGN|CANDIDATE|RUN", arguments->id, "d3, c812, e81200007 or r7",
               Options::Need::Required);
  arguments->store.declare(options);
  return [arguments](Output& output) { return run_show(*arguments, output); };
}

}  // namespace swarmsmith::cli
