#pragma once

#include <sqlite3.h>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "storage/store.h"

namespace swarmsmith::sqlite {

/// An error of SQLite: its message and its extended result code. The environment failed (disk full,
/// file damaged), or a row broke a constraint.
class SqliteError : public StoreFailure {
 public:
  SqliteError(int code, const std::string& message, std::string file = {})
      : StoreFailure(message, std::move(file)), code_(code) {}
  /// The code without its details: SQLITE_FULL, SQLITE_IOERR, SQLITE_CONSTRAINT, ...
  int primary_code() const { return code_ & 0xff; }

 private:
  int code_;
};

/// Largest size of a value. The largest values of stores are the texts of campaigns with their
/// pictures, at most 24 MB.
inline constexpr int kMostValueBytes = 25 << 20;

/// An open database file. Not thread-safe. The content of the file is only data and cannot run
/// anything: its triggers do not run, its views are not read unless that is allowed, its functions
/// are not trusted, and no statement can write its schema as text.
class Connection {
 public:
  /// `flags` as for sqlite3_open_v2. Throws SqliteError.
  Connection(const std::string& file, int flags);

  /// Whether views of the file may be read. Temporary views, which are the program's own, always
  /// may.
  void allow_views(bool allowed);

  sqlite3* handle() const { return handle_.get(); }
  /// The descriptor with which SQLite has the database file open; -1 without a file. It belongs to
  /// SQLite: use it only for queries and flock, and never close it.
  int descriptor() const { return descriptor_; }
  /// Runs every statement of `sql`, and ignores their rows. Throws SqliteError.
  void execute(const std::string& sql);
  /// Number of rows that the last statement changed.
  std::int64_t changes() const { return sqlite3_changes64(handle_.get()); }
  /// Length of the database file; and up to `count` of its bytes from `at` on. Both use the handle
  /// with which SQLite has the file open. No other code may open the file: when a process closes
  /// any descriptor of a file, it loses all its locks on it (decision 18). Throws SqliteError.
  std::int64_t file_size() const;
  std::string file_bytes(std::int64_t at, std::int64_t count) const;
  /// Path of the file, without symbolic links; empty when there is no file.
  std::string file() const;
  [[noreturn]] void fail(int code) const;
  [[noreturn]] void fail(int code, const std::string& message) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
  int descriptor_ = -1;
};

/// A prepared statement. Parameters and columns are numbered from the left. Bound texts must exist
/// until the statement has been stepped to its end or reset.
class Statement {
 public:
  /// Throws SqliteError when `sql` does not parse.
  Statement(const Connection& connection, std::string_view sql);

  /// Binds all parameters, in order.
  template <class... Values>
  Statement& bind(const Values&... values) {
    reset();
    int at = 0;
    (bind_one(++at, values), ...);
    return *this;
  }
  /// Moves to the next row; false at the end. Throws SqliteError.
  bool step();
  /// Binds, steps to the end and resets: for statements without rows.
  template <class... Values>
  void run(const Values&... values) {
    bind(values...);
    step();
    reset();
  }
  void reset() { sqlite3_reset(handle_.get()); }

  sqlite3_stmt* handle() const { return handle_.get(); }
  bool is_null(int column) const {
    return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL;
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  std::uint64_t bits(int column) const { return static_cast<std::uint64_t>(integer(column)); }
  double real(int column) const { return sqlite3_column_double(handle_.get(), column); }
  std::optional<double> optional_real(int column) const;
  std::string text(int column) const;

 private:
  void bind_one(int at, std::int64_t value) { check(sqlite3_bind_int64(handle_.get(), at, value)); }
  void bind_one(int at, std::uint64_t value) { bind_one(at, static_cast<std::int64_t>(value)); }
  void bind_one(int at, int value) { bind_one(at, static_cast<std::int64_t>(value)); }
  void bind_one(int at, bool value) { bind_one(at, static_cast<std::int64_t>(value)); }
  void bind_one(int at, double value) { check(sqlite3_bind_double(handle_.get(), at, value)); }
  void bind_one(int at, std::string_view value);
  void bind_one(int at, std::nullopt_t) { check(sqlite3_bind_null(handle_.get(), at)); }
  void bind_one(int at, const double* value) {  // null: NULL
    value != nullptr ? bind_one(at, *value) : bind_one(at, std::nullopt);
  }
  template <class T>
  void bind_one(int at, const std::optional<T>& value) {
    value ? bind_one(at, *value) : bind_one(at, std::nullopt);
  }
  static void check(int code);

  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

/// BEGIN IMMEDIATE ... COMMIT; rolls back when it ends without commit().
class Transaction {
 public:
  explicit Transaction(Connection& connection);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Connection& connection_;
};

/// The first column of the first row of `sql`, which must have one.
std::int64_t integer_of(const Connection& connection, std::string_view sql);
std::string text_of(const Connection& connection, std::string_view sql);

}  // namespace swarmsmith::sqlite
