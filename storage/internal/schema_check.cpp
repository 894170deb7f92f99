#include "storage/internal/schema_check.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/row_reader.h"
#include "storage/internal/schema.h"

namespace swarmsmith {
namespace {

using sqlite::Connection;
using sqlite::Statement;

struct Column {
  std::string name;
  std::string type;
  bool hidden = false;  ///< generated, or in a virtual table

  friend bool operator==(const Column&, const Column&) = default;
};

/// From type and name of an object to the name of its table and its SQL text.
using Objects = std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>>;

/// The text without characters that SQLite may change when it rewrites a text: blanks and quotes.
std::string bare(std::string text) {
  std::erase_if(text, [](char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '"' || c == '`' || c == '[' ||
           c == ']';
  });
  return text;
}

Objects objects_of(const Connection& connection, bool with_views) {
  Objects objects;
  Statement row(connection,
                "SELECT type, name, tbl_name, coalesce(sql, '') FROM sqlite_schema"
                " WHERE name NOT GLOB 'sqlite_stat[134]'");
  while (row.step()) {
    if (!with_views && row.text(0) == "view") continue;
    // A later version knows more modules, and writes their names when it opens the store.
    const bool has_names = row.text(0) == "view" && row.text(1) == "flavour_name";
    objects[{row.text(0), row.text(1)}] = {row.text(2), has_names ? "" : bare(row.text(3))};
  }
  return objects;
}

Connection made_anew(std::int64_t schema, bool with_views) {
  Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  create_tables(memory, schema);
  if (with_views) finish_schema(memory, schema);
  return memory;
}

/// The names of the tables, without virtual ones.
std::vector<std::string> tables_of(const Connection& connection) {
  std::vector<std::string> names;
  Statement table(connection,
                  "SELECT name FROM main.sqlite_schema WHERE type = 'table' AND rootpage > 0"
                  " AND name NOT GLOB 'sqlite_*' ORDER BY name");
  while (table.step())
    names.push_back(table.text(0));
  return names;
}

std::vector<Column> columns_of(const Connection& connection, const std::string& table) {
  std::vector<Column> columns;
  Statement column(connection,
                   "SELECT name, type, hidden FROM pragma_table_xinfo(?, 'main') ORDER BY cid");
  column.bind(table);
  while (column.step())
    columns.push_back({column.text(0), column.text(1), column.integer(2) != 0});
  return columns;
}

/// "column note added, column score missing"; "another text" when the columns are the same.
std::string difference(const std::vector<Column>& wanted, const std::vector<Column>& found) {
  std::vector<std::string> parts;
  const auto differ = [&](const auto& all, const auto& some, const char* what) {
    for (const Column& column : some) {
      if (std::ranges::find(all, column) == all.end())
        parts.push_back(fmt::format("column {} {}", column.name, what));
    }
  };
  differ(wanted, found, "added");
  differ(found, wanted, "missing");
  return parts.empty() ? "another text" : fmt::format("{}", fmt::join(parts, ", "));
}

using Tables = std::vector<std::pair<std::string, std::vector<Column>>>;

/// The tables of a schema; made once.
const Tables& tables_made(std::int64_t schema) {
  static std::mutex mutex;
  static std::map<std::int64_t, Tables> made;
  const std::scoped_lock lock(mutex);
  const auto [known, is_new] = made.try_emplace(schema);
  if (!is_new) return known->second;
  const Connection ours = made_anew(schema, false);
  for (const std::string& table : tables_of(ours))
    known->second.emplace_back(table, columns_of(ours, table));
  return known->second;
}

/// The objects of a store of this schema, with views if it is the current one; made once.
const Objects& objects_made(std::int64_t schema) {
  static std::mutex mutex;
  static std::map<std::int64_t, Objects> made;
  const std::scoped_lock lock(mutex);
  if (const auto known = made.find(schema); known != made.end()) return known->second;
  const bool with_views = schema == kSchemaVersion;
  Objects objects = objects_of(made_anew(schema, with_views), with_views);
  return made.emplace(schema, std::move(objects)).first->second;
}

constexpr const char* kNotOurs = "is not as Swarmsmith made it";

}  // namespace

std::vector<std::string> foreign_objects(const Connection& connection, std::int64_t schema) {
  const Objects& wanted = objects_made(schema);
  const Objects found = objects_of(connection, schema == kSchemaVersion);
  std::vector<std::string> foreign;
  for (const auto& [key, what] : found) {
    const auto& [type, name] = key;
    const auto known = wanted.find(key);
    if (known == wanted.end()) {
      foreign.push_back(type + " " + name);
    } else if (known->second != what) {
      const Tables& tables = tables_made(schema);
      const auto ours = std::ranges::find(
          tables, name, [](const auto& each) -> const auto& { return each.first; });
      const std::string how = type == "table" && ours != tables.end()
                                  ? difference(ours->second, columns_of(connection, name))
                                  : "another text";
      foreign.push_back(fmt::format("{} {} ({})", type, name, how));
    }
  }
  for (const auto& [key, what] : wanted) {
    if (!found.contains(key)) foreign.push_back(key.first + " " + key.second + " (missing)");
  }
  return foreign;
}

std::string listed_objects(const std::vector<std::string>& objects) {
  constexpr std::size_t kMost = 10;
  const std::size_t shown = std::min(objects.size(), kMost);
  std::string text = fmt::format("{}", fmt::join(std::span(objects).first(shown), ", "));
  if (objects.size() > shown) text += fmt::format(" and {} more", objects.size() - shown);
  return text;
}

Expected<void> check_schema(const Connection& connection, const std::filesystem::path& path) {
  const auto foreign = foreign_objects(connection, schema_of(connection));
  if (foreign.empty()) return {};
  return unexpected(
      ErrorKind::Corrupt,
      fmt::format("the store's schema is not as Swarmsmith made it: {}; nothing is written to it. "
                  "`swarmsmith backup {} copy.db` copies only the rows of Swarmsmith into a new "
                  "store, which can be used instead",
                  listed_objects(foreign), path.filename().string()),
      path.string());
}

Expected<void> check_tables(const Connection& connection, const std::filesystem::path& path) {
  const std::vector<std::string> found = tables_of(connection);
  for (const auto& [table, wanted] : tables_made(schema_of(connection))) {
    std::string how;
    if (std::ranges::find(found, table) == found.end()) {
      how = "it is missing, or no table";
    } else {
      std::vector<Column> has = columns_of(connection, table);
      if (has.size() > wanted.size()) has.resize(wanted.size());
      if (wanted != has) how = difference(wanted, has);
    }
    if (how.empty()) continue;
    return unexpected(
        ErrorKind::Corrupt,
        fmt::format("the store's table {} {} ({}); restore the store from a backup, or let "
                    "`swarmsmith recover` make a new one from what can be read",
                    table, kNotOurs, how),
        path.string());
  }
  return {};
}

std::string too_long_text(const Connection& connection) {
  struct Limit {
    const char *column, *table;
    std::int64_t most;
    std::int64_t schema = 1;  ///< the schema that added the column
  };
  constexpr std::int64_t kLongestPhrase = 8 << 20;
  constexpr std::array kLimits{
      Limit{"name", "campaign", kLongestName},
      Limit{"name", "source", kLongestName},
      Limit{"mission", "design", kLongestName},
      Limit{"method", "design", kLongestName},
      Limit{"flavour", "design", kLongestName, 4},
      Limit{"name", "design", kLongestName, 4},
      Limit{"reason", "design", kLongestReason},
      Limit{"machine", "phrase", kLongestPhrase, 4},
      Limit{"parameters", "phrase", kLongestPhrase, 4},
      Limit{"modules", "phrase", kLongestPhrase, 4},
  };
  const std::int64_t schema = sqlite::integer_of(connection, "PRAGMA user_version");
  for (const Limit& limit : kLimits) {
    if (schema < limit.schema) continue;
    const std::int64_t longest = sqlite::integer_of(
        connection,
        fmt::format("SELECT max(length(CAST({} AS BLOB))) FROM {}", limit.column, limit.table));
    if (longest <= limit.most) continue;
    return fmt::format("a {} in the store's table {} has {} bytes; the limit is {}", limit.column,
                       limit.table, longest, limit.most);
  }
  return {};
}

Expected<void> check_lengths(const Connection& connection, const std::filesystem::path& path) {
  const std::string found = too_long_text(connection);
  return found.empty() ? Expected<void>() : unexpected(ErrorKind::Corrupt, found, path.string());
}

void copy_rows(const Connection& from, const Connection& to) {
  for (const std::string& table : tables_of(to)) {
    std::vector<std::string> names;
    for (const Column& column : columns_of(to, table))
      names.push_back(column.name);
    const std::string columns = fmt::format("{}", fmt::join(names, ", "));
    const std::vector<std::string> values(names.size(), "?");
    Statement row(from, fmt::format("SELECT {} FROM main.{}", columns, table));
    Statement put(
        to, fmt::format("INSERT INTO {} ({}) VALUES ({})", table, columns, fmt::join(values, ",")));
    while (row.step()) {
      put.reset();
      for (int i = 0; i < static_cast<int>(names.size()); ++i)
        sqlite3_bind_value(put.handle(), i + 1, sqlite3_column_value(row.handle(), i));
      put.step();
    }
  }
}

}  // namespace swarmsmith
