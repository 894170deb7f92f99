#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/query_output.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  StoreArgument store;
  std::vector<std::string> words;
  bool csv = false;
};

constexpr const char* kViews =
    "SELECT v.name AS view, group_concat(c.name, ' ') AS columns "
    "FROM sqlite_master AS v JOIN pragma_table_info(v.name) AS c "
    "WHERE v.type = 'view' GROUP BY v.name ORDER BY v.name";

/// `query STORE SQL`, `query SQL` (the store from option or environment), `query STORE`. A
/// statement has blanks; a store's name that has them must be given with --store.
std::string take_sql(Arguments& arguments) {
  std::vector<std::string>& words = arguments.words;
  const bool named = !arguments.store.option.empty();
  if (!words.empty() && !named && words.front().find(' ') == std::string::npos) {
    arguments.store.word = words.front();
    words.erase(words.begin());
  }
  std::string sql;
  for (const std::string& word : words) sql += (sql.empty() ? "" : " ") + word;
  return sql;
}

ExitCode run(Arguments& arguments, Output& output) {
  const std::string sql = take_sql(arguments);
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const auto rows = select(**store, sql.empty() ? kViews : sql);
  if (!rows) return fail(output, ExitCode::Usage, rows.error());
  const Form form = arguments.csv ? Form::Csv : (output.json ? Form::Json : Form::Text);
  write_rows(output, *rows, form);
  return ExitCode::Done;
}

}  // namespace

Run declare_query(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  options.words("STORE_AND_SQL", arguments->words, "The store's file, then the statement");
  arguments->store.declare(options, false);
  options.flag("--csv", arguments->csv, "Write CSV: a header, full precision");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
