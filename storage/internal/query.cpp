#include "storage/internal/query.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/printed_ids.h"
#include "storage/internal/schema.h"

namespace swarmsmith {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Whether a statement may use the PRAGMA. Some PRAGMAs only report values; those that can also set
/// them are refused with an argument.
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

/// `views_recurse` points to a bool. If it is false, recursion in a view is refused, since it might
/// not end.
int only_reading(void* views_recurse, int action, const char* first, const char* second,
                 const char*, const char* view) {
  switch (action) {
    case SQLITE_RECURSIVE:
      return view == nullptr || *static_cast<bool*>(views_recurse) ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_FUNCTION:
      return SQLITE_OK;
    case SQLITE_UPDATE:
      // SQLite asks this when it sets up pragma_table_info(). Nothing is written, and nothing could
      // be: the file is open for reading only.
      return std::string_view(first) == "sqlite_master" ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_PRAGMA:
      return may_ask(first, second != nullptr) ? SQLITE_OK : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

using sqlite::kMostValueBytes;
constexpr std::int64_t kMostRowBytes = std::int64_t{2} * kMostValueBytes;

struct Limit {
  int which;
  int value;
};
constexpr int kMostSqlBytes = 1 << 20;
constexpr std::array<Limit, 4> kLimits{{{SQLITE_LIMIT_SQL_LENGTH, kMostSqlBytes},
                                        {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000},
                                        {SQLITE_LIMIT_ATTACHED, 0},
                                        {SQLITE_LIMIT_WORKER_THREADS, 0}}};

/// The memory that statements may use in addition to SQLite's memory so far. SQLite has one limit
/// for the process, so statements of several threads share the sum of their limits, until the last
/// one ends.
class SharedMemory {
 public:
  void add(std::int64_t bytes) {
    const std::scoped_lock lock(mutex_);
    if (allowed_.empty()) {
      used_before_ = sqlite3_memory_used();
      limit_before_ = sqlite3_hard_heap_limit64(-1);
    }
    allowed_.insert(bytes);
    set();
  }
  void remove(std::int64_t bytes) {
    const std::scoped_lock lock(mutex_);
    allowed_.erase(allowed_.find(bytes));
    set();
  }

 private:
  void set() const {
    sqlite3_hard_heap_limit64(
        allowed_.empty() ? limit_before_
                         : std::accumulate(allowed_.begin(), allowed_.end(), used_before_));
  }

  std::mutex mutex_;
  std::multiset<std::int64_t> allowed_;
  std::int64_t used_before_ = 0;
  std::int64_t limit_before_ = 0;
};

SharedMemory& shared_memory() {
  static SharedMemory memory;
  return memory;
}

/// The rules for a user's statement; they apply to the connection as long as this object exists.
class Rules {
 public:
  Rules(sqlite::Connection& connection, const StoreReader::QueryLimits& limits)
      : connection_(connection),
        handle_(connection.handle()),
        has_our_views_(has_our_views(connection)),
        deadline_(SteadyClock::now() +
                  std::chrono::duration_cast<SteadyClock::duration>(
                      std::chrono::duration<double>(std::clamp(limits.seconds, 0.0, 1e6)))),
        memory_(std::max<std::int64_t>(limits.memory, 1 << 20)) {
    shared_memory().add(memory_);
    constexpr int kInstructions = 2000;  // about 20 us
    for (std::size_t i = 0; i < kLimits.size(); ++i)
      limits_before_[i] = sqlite3_limit(handle_, kLimits[i].which, kLimits[i].value);
    // A store of an early schema is read with its own views.
    connection_.allow_views(limits.views_of_file || !has_our_views_);
    sqlite3_set_authorizer(handle_, only_reading, &has_our_views_);
    sqlite3_progress_handler(
        handle_, kInstructions,
        [](void* self) { return static_cast<Rules*>(self)->late() ? 1 : 0; }, this);
  }
  Rules(const Rules&) = delete;
  Rules& operator=(const Rules&) = delete;
  ~Rules() {
    sqlite3_set_authorizer(handle_, nullptr, nullptr);
    connection_.allow_views(false);
    sqlite3_progress_handler(handle_, 0, nullptr, nullptr);
    for (std::size_t i = 0; i < kLimits.size(); ++i)
      sqlite3_limit(handle_, kLimits[i].which, limits_before_[i]);
    shared_memory().remove(memory_);
  }
  bool late() const { return SteadyClock::now() >= deadline_; }

 private:
  sqlite::Connection& connection_;
  sqlite3* handle_;
  bool has_our_views_;
  SteadyClock::time_point deadline_;
  std::int64_t memory_;
  std::array<int, kLimits.size()> limits_before_{};
};

/// The error for a statement of our own: it is about the store.
Unexpected not_readable(const sqlite::Connection& connection, int code,
                        const StoreReader::QueryLimits& limits) {
  const std::string file = connection.file();
  if ((code & 0xff) == SQLITE_NOMEM) {
    return bad_input(fmt::format("this takes more memory than {} MB, the limit for reading a "
                                 "store; ask for one design or mission",
                                 limits.memory >> 20U),
                     file);
  }
  if ((code & 0xff) == SQLITE_TOOBIG) {
    return bad_input(
        fmt::format("the store has a value of more than {} MB", kMostValueBytes >> 20U), file);
  }
  if (code == SQLITE_AUTH) {
    return bad_input(
        "its views are not those of its schema; `swarmsmith backup` makes a copy with the right "
        "ones",
        file);
  }
  return bad_input(sqlite3_errmsg(connection.handle()), file);
}

/// The error for a statement that SQLite refused with this code, with SQLite's message or a better
/// one.
Unexpected refused(const sqlite::Connection& connection, int code, const std::string& sql,
                   const StoreReader::QueryLimits& limits) {
  if (!limits.typed) return not_readable(connection, code, limits);
  switch (code & 0xff) {
    case SQLITE_NOMEM:
      return bad_input(fmt::format("the query needs more memory than {} MB; ask for fewer rows or "
                                   "columns, or sort and group less",
                                   limits.memory >> 20U),
                       sql);
    case SQLITE_TOOBIG:
      if (sql.size() > std::size_t{kMostSqlBytes})
        return bad_input("the query is longer than 1 MB");
      return bad_input(fmt::format("a value in the query is longer than {} MB, the limit",
                                   kMostValueBytes >> 20U),
                       sql);
    default:
      return bad_input(sqlite3_errmsg(connection.handle()), sql);
  }
}

bool is_blank_text(const char* text) {
  const std::string_view rest(text);
  return std::all_of(rest.begin(), rest.end(),
                     [](unsigned char c) { return std::isspace(c) != 0 || c == ';'; });
}

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using UserStatement = std::unique_ptr<sqlite3_stmt, Finalize>;

Expected<UserStatement> prepare(const sqlite::Connection& connection, const std::string& sql,
                                const StoreReader::QueryLimits& limits) {
  sqlite3_stmt* prepared = nullptr;
  const char* tail = nullptr;
  const int code = sqlite3_prepare_v2(connection.handle(), sql.c_str(), -1, &prepared, &tail);
  UserStatement statement(prepared);
  if (code == SQLITE_AUTH && limits.typed) {
    return bad_input("a query may only read: no writing, attaching, transactions or settings", sql);
  }
  if (code != SQLITE_OK) return refused(connection, code, sql, limits);
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

/// Total bytes of the row's texts.
std::int64_t bytes_of(sqlite3_stmt* row, std::size_t width) {
  std::int64_t bytes = 0;
  for (std::size_t i = 0; i < width; ++i) {
    const int type = sqlite3_column_type(row, static_cast<int>(i));
    if (type != SQLITE_TEXT && type != SQLITE_BLOB) continue;
    bytes += sqlite3_column_bytes(row, static_cast<int>(i));
  }
  return bytes;
}

/// Passes rows to `on_row` until the end, or a limit.
Expected<StoreReader::QueryEnd> give_rows(
    sqlite::Connection& connection, sqlite3_stmt* row, const std::string& sql,
    const StoreReader::QueryLimits& limits, const Rules& rules,
    const std::function<void(const std::vector<StoreReader::Cell>&)>& on_row) {
  const auto width = static_cast<std::size_t>(sqlite3_column_count(row));
  StoreReader::QueryEnd end;
  std::int64_t given = 0;
  std::vector<StoreReader::Cell> cells(width);
  while (true) {
    const int code = sqlite3_step(row);
    if (code == SQLITE_DONE) return end;
    const bool enough = code == SQLITE_ROW && (end.rows >= limits.rows || rules.late());
    if (code == SQLITE_INTERRUPT || enough) {
      end.truncated = true;
      return end;
    }
    if (code != SQLITE_ROW) {
      // Either the statement is wrong (a number too large, bad JSON, too much memory), or the file.
      constexpr std::array<int, 4> kOwn{SQLITE_ERROR, SQLITE_TOOBIG, SQLITE_MISMATCH, SQLITE_NOMEM};
      if (std::ranges::count(kOwn, code & 0xff) == 0) connection.fail(code);
      return refused(connection, code, sql, limits);
    }
    const std::int64_t bytes = bytes_of(row, width);
    if (bytes > kMostRowBytes) {
      return bad_input(fmt::format("a row of the answer has {} MB; the limit is {} MB",
                                   bytes >> 20U, kMostRowBytes >> 20U),
                       limits.typed ? sql : connection.file());
    }
    given += bytes + static_cast<std::int64_t>(width * sizeof(StoreReader::Cell));
    if (given > limits.bytes) {
      end.truncated = true;
      return end;
    }
    for (std::size_t i = 0; i < width; ++i)
      cells[i] = cell_at(row, static_cast<int>(i));
    // A value that had no memory so far (zeroblob) may not have got any now.
    if (sqlite3_errcode(connection.handle()) == SQLITE_NOMEM) {
      return refused(connection, SQLITE_NOMEM, sql, limits);
    }
    on_row(cells);
    ++end.rows;
  }
}

}  // namespace

Expected<StoreReader::QueryEnd> run_query(
    sqlite::Connection& connection, const std::string& text, const StoreReader::QueryLimits& limits,
    const std::function<void(const std::vector<std::string>&)>& on_columns,
    const std::function<void(const std::vector<StoreReader::Cell>&)>& on_row) {
  // Sorts in memory obey the limit; on disk there would be none. Changing this setting makes SQLite
  // drop the lent views, so all statements of our own use the same setting.
  connection.execute(limits.typed ? "PRAGMA temp_store = MEMORY" : "PRAGMA temp_store = DEFAULT");
  lend_views(connection);
  const std::string sql = with_numbers_of_ids(text);
  const Rules rules(connection, limits);
  auto statement = prepare(connection, sql, limits);
  if (!statement) return Unexpected(statement.error());
  sqlite3_stmt* row = statement->get();

  const auto width = static_cast<std::size_t>(sqlite3_column_count(row));
  std::vector<std::string> names(width);
  for (std::size_t i = 0; i < width; ++i)
    names[i] = sqlite3_column_name(row, static_cast<int>(i));
  on_columns(names);
  return give_rows(connection, row, sql, limits, rules, on_row);
}

}  // namespace swarmsmith
