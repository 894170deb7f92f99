#include "storage/internal/open_writer.h"

#include <unistd.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"
#include "storage/internal/schema.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

/// Folds in the log that a crash has left and looks at every page.
Expected<void> recover(Connection& connection, const fs::path& path) {
  connection.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (auto sound = check_database_file(path); !sound) return sound;
  const std::string fault = sqlite::text_of(connection, "PRAGMA quick_check(1)");
  if (fault == "ok") return {};
  return unexpected(ErrorKind::Corrupt, damaged_text(fault + ", and it was not closed properly"),
                    path.string());
}

}  // namespace

Expected<WriterLock> lock_for_writing(const fs::path& path, std::chrono::milliseconds patience) {
  auto lock = LockFile::acquire(path, patience);
  if (!lock) return Unexpected(lock.error());
  const bool exists = fs::exists(path);
  const bool unclean = exists && (lock->left_behind() || has_pending_log(path));
  lock->set_suspect(unclean);
  if (exists) {
    if (auto sound = check_database_file(path); !sound) return Unexpected(sound.error());
  }
  return WriterLock{std::move(*lock), unclean};
}

Expected<Connection> connect_writer(const fs::path& path, bool unclean) {
  Connection connection(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (sqlite3_db_readonly(connection.handle(), "main") != 0) {
    return bad_input("the store may not be written by this user", path.string());
  }
  // A reader may be the first to open a store whose coordinator was killed: it then recovers the
  // log, and holds the file for that moment.
  sqlite3_busy_timeout(connection.handle(), 5000);
  const bool blank = is_blank(connection);
  if (!blank) {
    if (auto ours = check_identity(connection, path); !ours) return Unexpected(ours.error());
  }
  configure_writer(connection);
  if (sqlite::text_of(connection, "PRAGMA journal_mode") != "wal") {
    return bad_input("the file system cannot hold a write-ahead log; put the store on a local disk",
                     path.string());
  }
  if (unclean && !blank) {
    if (auto sound = recover(connection, path); !sound) return Unexpected(sound.error());
  }
  return connection;
}

void write_empty_store(Connection& connection) {
  create_schema(connection);
  write_maker(connection);
}

void name_flavours(Connection& connection, const std::vector<DesignRow>& designs) {
  sqlite::Transaction transaction(connection);
  Statement design(connection, "UPDATE design SET flavour = ?2 WHERE id = ?1 AND flavour = ''");
  for (const DesignRow& row : designs)
    if (!row.flavour.empty()) design.run(row.id.value, row.flavour);
  transaction.commit();
}

Unexpected not_writable(const sqlite::SqliteError& error, const fs::path& path) {
  const int code = error.primary_code();
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    return unexpected(ErrorKind::Corrupt, damaged_text(error.what()), path.string());
  }
  return unexpected(ErrorKind::Unavailable,
                    fmt::format("the store cannot be opened for writing: {}", error.what()),
                    path.string());
}

}  // namespace swarmsmith
