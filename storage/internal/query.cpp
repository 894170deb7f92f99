#include "storage/internal/query.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace swarmsmith {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Settings that only tell; those that can also be set are refused with an argument.
bool may_ask(std::string_view pragma, bool has_argument) {
  constexpr std::array<std::string_view, 8> kTell{
      "table_info", "table_xinfo",      "table_list",     "index_list",
      "index_info", "foreign_key_list", "collation_list", "compile_options"};
  constexpr std::array<std::string_view, 5> kAlsoSet{"user_version", "application_id", "page_size",
                                                     "page_count", "freelist_count"};
  const auto in = [&](const auto& names) {
    return std::find(names.begin(), names.end(), pragma) != names.end();
  };
  return in(kTell) || (in(kAlsoSet) && !has_argument);
}

int only_reading(void*, int action, const char* first, const char* second, const char*,
                 const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_FUNCTION:
    case SQLITE_RECURSIVE:
      return SQLITE_OK;
    case SQLITE_UPDATE:
      // What SQLite asks when it sets up pragma_table_info(); nothing is written, and nothing could
      // be: the file is open for reading only.
      return std::string_view(first) == "sqlite_master" ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_PRAGMA:
      return may_ask(first, second != nullptr) ? SQLITE_OK : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

/// The rules of a user's statement, on the connection while this lives.
class Rules {
 public:
  Rules(sqlite::Connection& connection, double seconds)
      : handle_(connection.handle()),
        deadline_(SteadyClock::now() +
                  std::chrono::duration_cast<SteadyClock::duration>(
                      std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6)))) {
    constexpr int kInstructions = 2000;  // some 20 us
    sqlite3_set_authorizer(handle_, only_reading, nullptr);
    sqlite3_progress_handler(
        handle_, kInstructions,
        [](void* self) { return static_cast<Rules*>(self)->late() ? 1 : 0; }, this);
  }
  Rules(const Rules&) = delete;
  Rules& operator=(const Rules&) = delete;
  ~Rules() {
    sqlite3_set_authorizer(handle_, nullptr, nullptr);
    sqlite3_progress_handler(handle_, 0, nullptr, nullptr);
  }
  bool late() const { return SteadyClock::now() >= deadline_; }

 private:
  sqlite3* handle_;
  SteadyClock::time_point deadline_;
};

bool is_blank_text(const char* text) {
  const std::string_view rest(text);
  return std::all_of(rest.begin(), rest.end(),
                     [](unsigned char c) { return std::isspace(c) != 0 || c == ';'; });
}

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using UserStatement = std::unique_ptr<sqlite3_stmt, Finalize>;

Expected<UserStatement> prepare(const sqlite::Connection& connection, const std::string& sql) {
  sqlite3_stmt* prepared = nullptr;
  const char* tail = nullptr;
  const int code = sqlite3_prepare_v2(connection.handle(), sql.c_str(), -1, &prepared, &tail);
  UserStatement statement(prepared);
  if (code == SQLITE_AUTH) {
    return bad_input("a query may only read: no writing, attaching, transactions or settings", sql);
  }
  if (code != SQLITE_OK) return bad_input(sqlite3_errmsg(connection.handle()), sql);
  if (statement == nullptr) return bad_input("the query is empty", sql);
  if (!is_blank_text(tail)) return bad_input("one statement at a time, please", tail);
  if (sqlite3_stmt_readonly(prepared) == 0) return bad_input("a query may only read", sql);
  return statement;
}

StoreReader::Cell cell_at(sqlite3_stmt* row, int column) {
  using Type = StoreReader::Cell::Type;
  switch (sqlite3_column_type(row, column)) {
    case SQLITE_NULL:
      return {};
    case SQLITE_INTEGER:
      return {Type::Integer, std::to_string(sqlite3_column_int64(row, column))};
    case SQLITE_FLOAT:
      return {Type::Real, fmt::format("{}", sqlite3_column_double(row, column))};
    default:
      break;  // a blob, which our tables do not have, is shown by its bytes
  }
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
  return {Type::Text, bytes == nullptr ? std::string() : std::string(bytes, size)};
}

}  // namespace

Expected<StoreReader::QueryEnd> run_query(
    sqlite::Connection& connection, const std::string& sql, const StoreReader::QueryLimits& limits,
    const std::function<void(const std::vector<std::string>&)>& on_columns,
    const std::function<void(const std::vector<StoreReader::Cell>&)>& on_row) {
  const Rules rules(connection, limits.seconds);
  auto statement = prepare(connection, sql);
  if (!statement) return Unexpected(statement.error());
  sqlite3_stmt* row = statement->get();

  const auto width = static_cast<std::size_t>(sqlite3_column_count(row));
  std::vector<std::string> names(width);
  for (std::size_t i = 0; i < width; ++i)
    names[i] = sqlite3_column_name(row, static_cast<int>(i));
  on_columns(names);

  StoreReader::QueryEnd end;
  std::vector<StoreReader::Cell> cells(width);
  while (true) {
    const int code = sqlite3_step(row);
    if (code == SQLITE_DONE) return end;
    if (code == SQLITE_INTERRUPT ||
        (code == SQLITE_ROW && (end.rows >= limits.rows || rules.late()))) {
      end.truncated = true;
      return end;
    }
    if (code != SQLITE_ROW) {
      // The statement's own fault (a number too large, bad JSON), or the file's.
      if ((code & 0xff) != SQLITE_ERROR && (code & 0xff) != SQLITE_TOOBIG &&
          (code & 0xff) != SQLITE_MISMATCH) {
        connection.fail(code);
      }
      return bad_input(sqlite3_errmsg(connection.handle()), sql);
    }
    for (std::size_t i = 0; i < width; ++i)
      cells[i] = cell_at(row, static_cast<int>(i));
    on_row(cells);
    ++end.rows;
  }
}

}  // namespace swarmsmith
