#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/suggestion.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_campaigns.h"
#include "cli/output/stored_quarantine.h"
#include "cli/output/stored_stages.h"
#include "sim/control/flavour.h"
#include "sim/files/robot_file.h"

namespace swarmsmith::cli {
namespace {

/// A kind of thing that can be listed: rows of a view, with the columns that fit on a screen and
/// all columns.
struct Kind {
  std::string_view name;
  std::string_view from;
  std::string_view columns;
  std::string_view order;
};

constexpr std::array<Kind, 6> kKinds = {{
    {"designs",
     {},  // designs_with_means()
     "design, mission, method, repetition, state, iteration, used, budget, best_candidate, "
     "coalesce(test_mean, best_mean, score_mean) AS mean, "
     "CASE WHEN test_mean IS NOT NULL THEN test_runs || iif(test_runs = 1, ' test', ' tests') "
     "WHEN best_mean IS NOT NULL THEN 'race' "
     "WHEN score_mean IS NOT NULL THEN score_runs || ' later' END AS mean_of",
     "design"},
    {"candidates", "v_candidates",
     "candidate, design, iteration, parent, n_states, n_transitions, runs, mean, eliminated_in",
     "candidate"},
    {"evaluations", "v_evaluations",
     "id, design, candidate, purpose, pair, seed, iteration, status, score, wall_ms, worker",
     "candidate, purpose, pair"},
    {"elites",
     "(SELECT e.*, c.n_states, c.n_transitions, c.fsm_config, t.test_mean, t.test_runs "
     "FROM v_convergence AS e JOIN v_candidates AS c ON c.candidate = e.candidate "
     "LEFT JOIN v_leaderboard AS t ON t.design = e.design AND t.candidate = e.candidate "
     "WHERE e.iteration = (SELECT max(iteration) FROM v_convergence AS l WHERE l.design = "
     "e.design))",
     "design, iteration, rank, candidate, mean, n, test_mean, test_runs, n_states, n_transitions",
     "design, rank"},
    {"runs", "v_real_runs",
     "id, name, mission, candidate, source, score, verdict, overridden_by, biased, robots, "
     "recorded",
     "run"},
    {"workers", "v_workers", "worker, host, pid, slots, state, done, failed, first_seen, last_seen",
     "worker"},
}};

struct LsArguments {
  std::string kind;
  StoreArgument store;
  std::string where;
  std::string sort;
  std::optional<std::int64_t> limit;
};

/// The user's own text becomes part of the statement; this is safe because the connection is
/// read-only.
std::string statement(const Kind& kind, const LsArguments& arguments, bool all_columns,
                      bool several_campaigns, bool has_principals) {
  std::string columns(all_columns ? "*" : kind.columns);
  std::string from = kind.name == "designs" ? designs_with_means() : std::string(kind.from);
  if (kind.name == "workers" && has_principals) {
    from = workers_with_quarantine();
    if (!all_columns) columns += ", quarantined_since, quarantined_for";
  }
  if (!all_columns && several_campaigns && kind.name == "designs") columns += ", campaign";
  std::string sql = "SELECT " + columns + " FROM " + from;
  if (!arguments.where.empty()) sql += " WHERE " + arguments.where;
  sql += " ORDER BY " + (arguments.sort.empty() ? std::string(kind.order) : arguments.sort);
  return sql;
}

constexpr std::string_view kFlavours = "flavours";
constexpr std::string_view kRobots = "robots";

using Cell = StoreReader::Cell;

Cell text_cell(const std::string& value) {
  return {.type = Cell::Type::Text, .text = value};
}
Cell count_cell(std::size_t value) {
  return {.type = Cell::Type::Integer, .text = std::to_string(value)};
}
Cell real_cell(double value) {
  return {.type = Cell::Type::Real, .text = json_number(value)};
}

/// The built-in flavours, for which no store is needed.
Rows flavour_rows() {
  Rows rows{
      .columns = {"flavour", "reference", "states", "transitions", "behaviours", "conditions"},
      .cells = {}};
  for (const Flavour* flavour : all_flavours()) {
    rows.cells.push_back({text_cell(flavour->name), text_cell(flavour->reference),
                          count_cell(static_cast<std::size_t>(flavour->most_states)),
                          count_cell(static_cast<std::size_t>(flavour->most_transitions)),
                          count_cell(flavour->behaviours.size()),
                          count_cell(flavour->conditions.size())});
  }
  return rows;
}

/// The built-in robots.
Rows robot_rows() {
  Rows rows{.columns = {"robot", "mass_kg", "track_m", "max_speed_mps", "proximity_sensors",
                        "light_sensors", "ground_points", "neighbours", "neighbours_range_m"},
            .cells = {}};
  for (const std::string& name : robot_names()) {
    const Robot robot = find_robot(name, {}).value();
    const std::size_t rays = robot.proximity.rays_deg.size();
    const std::size_t lights = robot.light.angles_deg.size();
    const bool by_radio = robot.neighbours.source == NeighbourSensor::Source::Radio;
    rows.cells.push_back(
        {text_cell(name), real_cell(robot.body.mass_kg), real_cell(robot.drive.track_m),
         real_cell(robot.drive.max_speed_mps), count_cell(rays),
         count_cell(lights == 0 ? rays : lights), count_cell(robot.ground.places.size()),
         text_cell(by_radio ? "radio" : "sight"), real_cell(robot.neighbours.range_m)});
  }
  return rows;
}

/// The rows as a subquery. The names of built-in things have no quotes.
std::string as_subquery(const Rows& rows) {
  std::vector<std::string> names;
  names.reserve(rows.columns.size());
  for (std::size_t i = 0; i < rows.columns.size(); ++i)
    names.push_back(fmt::format("column{} AS {}", i + 1, rows.columns[i]));
  std::vector<std::string> values;
  values.reserve(rows.cells.size());
  for (const std::vector<Cell>& cells : rows.cells) {
    std::vector<std::string> row;
    row.reserve(cells.size());
    for (const Cell& cell : cells)
      row.push_back(cell.type == Cell::Type::Text ? "'" + cell.text + "'" : cell.text);
    values.push_back(fmt::format("({})", fmt::join(row, ", ")));
  }
  return fmt::format("(SELECT {} FROM (VALUES {}))", fmt::join(names, ", "),
                     fmt::join(values, ", "));
}

/// The limit of rows for a query.
std::int64_t row_limit(const LsArguments& arguments, const Output& output) {
  constexpr std::int64_t kShown = 100;
  constexpr std::int64_t kAll = 1'000'000'000;
  const std::int64_t limit = arguments.limit.value_or(output.json ? 0 : kShown);
  return limit == 0 ? kAll : limit;
}

ExitCode show_rows(Rows rows, Output& output) {
  const bool truncated = rows.truncated;
  write_rows(output, std::move(rows), output.json ? Form::Json : Form::Text);
  if (truncated) print_note(output, "`--limit 0` shows all");
  return ExitCode::Done;
}

ExitCode list_built_in(const LsArguments& arguments, Output& output) {
  if (!arguments.store.word.empty() || !arguments.store.option.empty()) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput,
                      "`ls " + arguments.kind + "` lists what is built in: leave the store out"});
  }
  const std::string from = as_subquery(arguments.kind == kFlavours ? flavour_rows() : robot_rows());
  const Kind kind{.name = arguments.kind, .from = from, .columns = "*", .order = "NULL"};
  auto rows = select(*StoreReader::of_no_store(), statement(kind, arguments, true, false, false),
                     {.rows = row_limit(arguments, output)});
  if (!rows) return fail(output, ExitCode::Usage, rows.error());
  return show_rows(*std::move(rows), output);
}

ExitCode run_ls(const LsArguments& arguments, Output& output) {
  if (arguments.kind == kFlavours || arguments.kind == kRobots)
    return list_built_in(arguments, output);
  const Kind* kind = nullptr;
  for (const Kind& known : kKinds) {
    if (known.name == arguments.kind) kind = &known;
  }
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const bool several = (*store)->campaigns().size() > 1;
  auto rows =
      select(**store, statement(*kind, arguments, output.json, several, (*store)->schema() >= 6),
             {.rows = row_limit(arguments, output)});
  if (!rows) return fail(output, ExitCode::Usage, rows.error());
  letter_ids(*rows);
  const auto stages = StoredStages::read(**store);
  if (!stages) return fail(output, ExitCode::Store, stages.error());
  if (kind->name == "designs") mark_interrupted(*rows, has_writer(*arguments.store.path()));
  if (!output.json && kind->name == "designs") stages->tell(*rows);
  if (!output.json && is_of_programs(**store)) as_costs(*rows);
  return show_rows(*std::move(rows), output);
}

}  // namespace

CommandRun declare_ls(Options& options) {
  auto arguments = std::make_shared<LsArguments>();
  std::vector<std::string> kinds;
  kinds.reserve(std::size(kKinds));
  for (const Kind& kind : kKinds)
    kinds.emplace_back(kind.name);
  kinds.emplace_back(kFlavours);
  kinds.emplace_back(kRobots);
  options.choice("KIND", arguments->kind, kinds, "What to list", Options::Need::Required);
  arguments->store.declare(options);
  options.text("--where SQL", arguments->where, "Condition in SQL, such as \"mean > 2.5\"");
  options.text("--sort SQL", arguments->sort, "Columns to sort by, such as \"mean DESC\"");
  options.integer("--limit", arguments->limit, {0, 1'000'000'000},
                  "Maximum number of rows; 0 for all (default 100, all with --json)");
  return [arguments](Output& output) { return run_ls(*arguments, output); };
}

}  // namespace swarmsmith::cli
