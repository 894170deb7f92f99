#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text/csv.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/output/query_output.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

struct QueryArguments {
  StoreArgument store;
  std::vector<std::string> words;
  bool csv = false;
  bool lists = false;
  std::optional<std::int64_t> limit;
  std::optional<std::int64_t> seconds;

  StoreReader::QueryLimits limits() const {
    StoreReader::QueryLimits limits{.views_of_file = true};
    if (limit) limits.rows = *limit > 0 ? *limit : std::numeric_limits<std::int64_t>::max();
    if (seconds) limits.seconds = static_cast<double>(*seconds);
    return limits;
  }
};

constexpr const char* kViews =
    "SELECT v.name AS view, group_concat(c.name, ' ') AS columns "
    "FROM sqlite_master AS v JOIN pragma_table_info(v.name) AS c "
    "WHERE v.type = 'view' AND v.name GLOB 'v_*' GROUP BY v.name ORDER BY v.name";

/// Takes the statement from the arguments: `query SQL STORE`, `query SQL` (the store from the
/// option or the environment), `query STORE`; also `query STORE SQL`. The argument with blanks is
/// the statement; a store whose name has blanks must be given with --store.
std::string take_sql(QueryArguments& arguments) {
  std::vector<std::string>& words = arguments.words;
  const bool named = !arguments.store.option.empty();
  if (!words.empty() && !named && words.front().find(' ') == std::string::npos) {
    arguments.store.word = words.front();
    words.erase(words.begin());
  } else if (words.size() == 2 && !named && words.back().find(' ') == std::string::npos) {
    arguments.store.word = words.back();
    words.pop_back();
  }
  std::string sql;
  for (const std::string& word : words)
    sql += (sql.empty() ? "" : " ") + word;
  return sql;
}

/// Within the limits there was no row at all, so there is no answer.
ExitCode fail_without_a_row(const StoreReader::QueryLimits& limits, Output& output) {
  return fail(
      output, ExitCode::Failed,
      fmt::format("the statement was ended before its first row: it took over {:g} s, which "
                  "--seconds changes, or the row is too large",
                  limits.seconds));
}

/// Writes rows as they arrive, so that a table of millions of rows is never in memory.
ExitCode write_csv(StoreReader& store, const std::string& sql, StoreReader::QueryLimits limits,
                   Output& output) {
  limits.bytes = std::numeric_limits<std::int64_t>::max();
  const auto end = store.query(
      sql, limits,
      [&](const std::vector<std::string>& columns) { write_data(output, csv_line(columns)); },
      [&](const std::vector<StoreReader::Cell>& cells) {
        write_data(output, cells_as_csv(cells));
      });
  if (!end) return fail(output, ExitCode::Usage, end.error());
  if (end->truncated && end->rows == 0) return fail_without_a_row(limits, output);
  if (end->truncated) note_truncated(output, static_cast<std::size_t>(end->rows));
  return ExitCode::Done;
}

ExitCode run_query(QueryArguments& arguments, Output& output) {
  const std::string sql = take_sql(arguments);
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const std::string statement = sql.empty() ? kViews : sql;
  StoreReader::QueryLimits limits = arguments.limits();
  limits.typed = !sql.empty();
  if (arguments.csv) return write_csv(**store, statement, limits, output);
  auto rows = select(**store, statement, limits);
  if (!rows) return fail(output, ExitCode::Usage, rows.error());
  if (rows->truncated && rows->cells.empty()) return fail_without_a_row(limits, output);
  const Form json = arguments.lists ? Form::JsonLists : Form::Json;
  write_rows(output, *std::move(rows), output.json ? json : Form::Text);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_query(Options& options) {
  auto arguments = std::make_shared<QueryArguments>();
  options.words("SQL_AND_STORE STORE", arguments->words, "The statement, then the store's file");
  arguments->store.declare(options, false);
  options.flag("--csv", arguments->csv, "Write CSV: a header, full precision");
  options.flag("--lists", arguments->lists,
               "With --json: each row a list in the order of the columns, not an object");
  options.integer("--limit", arguments->limit, {0, 1'000'000'000},
                  "Maximum number of rows; 0 for all (default 1,000,000)");
  options.integer("--seconds", arguments->seconds, {1, 1'000'000},
                  "Longest time of the statement (default 60)");
  return [arguments](Output& output) { return run_query(*arguments, output); };
}

}  // namespace swarmsmith::cli
