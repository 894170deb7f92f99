#include "storage/internal/sqlite.h"

#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "base/assert.h"
#include "storage/internal/spill_place.h"

namespace swarmsmith::sqlite {

namespace {

/// The name of the connection's database file.
std::string file_of(sqlite3* handle) {
  const char* file = sqlite3_db_filename(handle, "main");
  return file == nullptr ? std::string() : std::string(file);
}

sqlite3_file& database_of(sqlite3* handle) {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(handle, "main", SQLITE_FCNTL_FILE_POINTER, static_cast<void*>(&file));
  SWARMSMITH_ASSERT(file != nullptr && file->pMethods != nullptr, "the database is a file");
  return *file;
}

/// Why an operation failed: SQLite says only that it failed, and the system knows the reason.
std::string reason_of(sqlite3* handle) {
  const int reason = sqlite3_system_errno(handle);
  return reason == 0 ? std::string(sqlite3_errmsg(handle))
                     : fmt::format("{} ({})", sqlite3_errmsg(handle), std::strerror(reason));
}

/// "disk I/O error" does not say which error; the system's message does. After a failed commit the
/// system's error is stored with the log's file.
std::string message_of(sqlite3* handle, int code) {
  if ((code & 0xff) != SQLITE_IOERR) return sqlite3_errmsg(handle);
  if (sqlite3_system_errno(handle) != 0) return reason_of(handle);
  sqlite3_file* log = nullptr;
  int reason = 0;
  sqlite3_file_control(handle, "main", SQLITE_FCNTL_JOURNAL_POINTER, static_cast<void*>(&log));
  if (log != nullptr && log->pMethods != nullptr)
    log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &reason);
  const std::string message = sqlite3_errmsg(handle);
  return reason == 0 ? message : fmt::format("{} ({})", message, std::strerror(reason));
}

/// Watches SQLite's system calls while it opens a database in this thread, to get the descriptor,
/// which SQLite does not tell. SQLite's system calls can be replaced (sqlite3_vfs::xSetSystemCall).
class Listener {
 public:
  Listener() {
    static const bool listens = replace_calls();
    SWARMSMITH_ASSERT(listens, "SQLite's calls of the system can be replaced");
    now_ = this;
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { now_ = nullptr; }

  int descriptor() const { return descriptor_; }

 private:
  using Open = int (*)(const char*, int, int);
  using Stat = int (*)(const char*, struct stat*);

  static bool replace_calls() {
    if (sqlite3_initialize() != SQLITE_OK) return false;
    sqlite3_vfs* system = sqlite3_vfs_find("unix");
    if (system == nullptr) return false;
    open_ = reinterpret_cast<Open>(system->xGetSystemCall(system, "open"));
    stat_ = reinterpret_cast<Stat>(system->xGetSystemCall(system, "stat"));
    const auto set = [&](const char* name, auto* call) {
      return system->xSetSystemCall(system, name, reinterpret_cast<sqlite3_syscall_ptr>(call));
    };
    return set("open", &open) == SQLITE_OK && set("stat", &stat) == SQLITE_OK;
  }
  static int open(const char* path, int flags, int mode) {
    const int descriptor = open_(path, flags, mode);
    if (now_ != nullptr && descriptor >= 0) now_->descriptor_ = descriptor;
    return descriptor;
  }
  /// SQLite calls this to find out whether it still has a descriptor of the file open that it can
  /// use again. Each connection must have its own descriptor, which has its own lock.
  static int stat(const char* path, struct stat* found) {
    if (now_ == nullptr) return stat_(path, found);
    errno = ENOENT;
    return -1;
  }

  static inline Open open_ = nullptr;
  static inline Stat stat_ = nullptr;
  static thread_local Listener* now_;
  int descriptor_ = -1;
};

thread_local Listener* Listener::now_ = nullptr;

}  // namespace

Connection::Connection(const std::string& file, int flags) {
  sqlite3* opened = nullptr;
  // Only the owner can read a new store and the files that SQLite makes beside it. The file is made
  // without opening it, since only SQLite may open it.
  if ((flags & SQLITE_OPEN_CREATE) != 0 && file != ":memory:")
    mknod(file.c_str(), S_IFREG | 0600, 0);
  const Listener listener;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX,
                                   vfs_that_spills_beside(file));
  handle_.reset(opened);
  if (code == SQLITE_OK && !this->file().empty()) descriptor_ = listener.descriptor();
  if (opened == nullptr) throw SqliteError(code, sqlite3_errstr(code));
  sqlite3_extended_result_codes(opened, 1);
  if (code != SQLITE_OK) fail(code, reason_of(opened));
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  allow_views(false);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMostValueBytes);
}

void Connection::allow_views(bool allowed) {
  sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_ENABLE_VIEW, allowed ? 1 : 0, nullptr);
}

std::int64_t Connection::file_size() const {
  sqlite3_file& file = database_of(handle_.get());
  sqlite3_int64 size = 0;
  if (const int code = file.pMethods->xFileSize(&file, &size); code != SQLITE_OK)
    fail(code, "its size cannot be read");
  return size;
}

std::string Connection::file_bytes(std::int64_t at, std::int64_t count) const {
  constexpr std::int64_t kAtOnce = 1 << 24;
  sqlite3_file& file = database_of(handle_.get());
  std::string bytes(
      static_cast<std::size_t>(std::max<std::int64_t>(0, std::min(count, file_size() - at))), '\0');
  for (std::size_t done = 0; done < bytes.size(); done += kAtOnce) {
    const auto part = static_cast<int>(std::min<std::size_t>(kAtOnce, bytes.size() - done));
    const int code = file.pMethods->xRead(&file, bytes.data() + done, part,
                                          at + static_cast<std::int64_t>(done));
    // The missing part of a file that was cut off meanwhile is read as zeros.
    if (code != SQLITE_OK && code != SQLITE_IOERR_SHORT_READ) fail(code, "it cannot be read");
  }
  return bytes;
}

std::string Connection::file() const {
  return file_of(handle_.get());
}

void Connection::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Connection::fail(int code) const {
  throw SqliteError(code, message_of(handle_.get(), code), file_of(handle_.get()));
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
  const std::string message =
      message_of(connection, code);  // read it before `reset`, which clears it
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
  // An empty view may have a null pointer, which SQLite would treat as NULL.
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
