#include "storage/internal/sqlite.h"

#include "base/assert.h"

namespace swarmsmith::sqlite {

namespace {

/// Where the connection's rows are.
std::string file_of(sqlite3* handle) {
  const char* file = sqlite3_db_filename(handle, "main");
  return file == nullptr ? std::string() : std::string(file);
}

}  // namespace

Connection::Connection(const std::string& file, int flags) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(opened);
  if (opened == nullptr) throw SqliteError(code, sqlite3_errstr(code));
  sqlite3_extended_result_codes(opened, 1);
  if (code != SQLITE_OK) fail(code);
}

void Connection::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Connection::fail(int code) const {
  throw SqliteError(code, sqlite3_errmsg(handle_.get()), file_of(handle_.get()));
}

void Connection::fail(int code, const std::string& message) const {
  throw SqliteError(code, message, file_of(handle_.get()));
}

Statement::Statement(const Connection& connection, std::string_view sql) {
  sqlite3_stmt* prepared = nullptr;
  const int code = sqlite3_prepare_v3(connection.handle(), sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &prepared, nullptr);
  if (code != SQLITE_OK) connection.fail(code);
  handle_.reset(prepared);
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  sqlite3* connection = sqlite3_db_handle(handle_.get());
  const std::string message = sqlite3_errmsg(connection);  // which `reset` takes away
  reset();
  throw SqliteError(code, message, file_of(connection));
}

std::optional<double> Statement::optional_real(int column) const {
  return is_null(column) ? std::nullopt : std::optional(real(column));
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

void Statement::bind_one(int at, std::string_view value) {
  // An empty view may have no address, which SQLite would take for NULL.
  const char* bytes = value.empty() ? "" : value.data();
  check(sqlite3_bind_text64(handle_.get(), at, bytes, value.size(), SQLITE_STATIC, SQLITE_UTF8));
}

void Statement::check(int code) {
  SWARMSMITH_ASSERT(code == SQLITE_OK || code == SQLITE_NOMEM, "a statement has the parameter");
  if (code != SQLITE_OK) throw SqliteError(code, sqlite3_errstr(code));
}

Transaction::Transaction(Connection& connection) : connection_(connection) {
  connection_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (sqlite3_get_autocommit(connection_.handle()) == 0) {
    sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

void Transaction::commit() {
  connection_.execute("COMMIT");
}

std::int64_t integer_of(const Connection& connection, std::string_view sql) {
  Statement statement(connection, sql);
  SWARMSMITH_ASSERT(statement.step(), "the query has a row");
  return statement.integer(0);
}

std::string text_of(const Connection& connection, std::string_view sql) {
  Statement statement(connection, sql);
  SWARMSMITH_ASSERT(statement.step(), "the query has a row");
  return statement.text(0);
}

}  // namespace swarmsmith::sqlite
