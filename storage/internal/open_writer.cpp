#include "storage/internal/open_writer.h"

#include <unistd.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/closed_file.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/reading.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/schema.h"
#include "storage/internal/schema_check.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

/// Moves the log that a crash has left into the file, and checks the whole file: every page, its
/// keys, and whether its rows are in a committed state.
Expected<void> check_all(Connection& connection, const fs::path& path, bool unclean) {
  connection.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (auto sound = check_database_file(connection, path); !sound) return sound;
  const LongCheck progress(connection, path);
  const auto faults = faults_of(connection);
  if (faults.empty()) return {};
  const std::string why =
      unclean ? ", and it was not closed properly" : ", and it is not the file that was closed";
  return unexpected(ErrorKind::Corrupt, damaged_text(faults.front() + why), path.string());
}

/// Checks the store and sets WAL mode, without changing rows. `unclean`: the last writer did not
/// end cleanly.
Expected<void> prepare(Connection& connection, const fs::path& path, bool unclean) {
  if (sqlite3_db_readonly(connection.handle(), "main") != 0) {
    return bad_input("the store may not be written by this user", path.string());
  }
  const bool blank = is_blank(connection);
  if (!blank) {
    if (auto ours = check_identity(connection, path); !ours) return ours;
    if (auto same = check_schema(connection, path); !same) return same;
    if (auto texts = check_lengths(connection, path); !texts) return texts;
  }
  const bool known = !unclean && !blank && is_as_closed(connection);
  configure_writer(connection);
  if (sqlite::text_of(connection, "PRAGMA journal_mode") != "wal") {
    return bad_input("the file system cannot hold a write-ahead log; put the store on a local disk",
                     path.string());
  }
  return known || blank ? Expected<void>() : check_all(connection, path, unclean);
}

}  // namespace

Expected<Writer> open_writer(const fs::path& path, std::chrono::milliseconds patience) {
  auto lock = LockFile::acquire(path, patience);
  if (!lock) return Unexpected(lock.error());
  std::error_code none;
  const bool unclean = fs::exists(path, none) && (lock->left_behind() || has_pending_log(path));
  lock->set_suspect(unclean);
  Connection connection(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  auto file = HeldFile::hold(connection, path);
  if (!file) return Unexpected(file.error());
  if (auto sound = check_database_file(connection, path); !sound) return Unexpected(sound.error());
  // A reader may be the first to open a store whose coordinator was killed: it then recovers the
  // log, and locks the file for that moment.
  sqlite3_busy_timeout(connection.handle(), 5000);
  const std::int64_t version = sqlite::integer_of(connection, "PRAGMA data_version");
  if (auto ready = prepare(connection, path, unclean); !ready) return Unexpected(ready.error());
  file->fate();  // the file is watched from now on
  return Writer{std::move(*lock), std::move(connection), std::move(*file), version};
}

Lost save_lost(Writer& writer, const std::string& fate) {
  writer.is_lost = true;
  // The log must not be moved into a file that is no longer the store's, and the next writer must
  // not trust that file.
  sqlite3_db_config(writer.connection.handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  writer.lock.set_suspect(true);
  const auto saved = writer.file.save(writer.connection);
  const std::string rest =
      saved ? *saved : "what it held could not be saved: " + to_string(saved.error());
  return {
      .saved = saved.has_value(),
      .error = {ErrorKind::Conflict, fmt::format("{} while it was being written; {}", fate, rest),
                writer.file.path().string()}};
}

void give_up(Writer& writer) {
  if (writer.is_lost) return;
  if (const std::string fate = writer.file.fate(); !fate.empty()) {
    save_lost(writer, fate);
    return;
  }
  close_file(writer.connection);
}

void write_empty_store(Connection& connection) {
  create_schema(connection);
  write_maker(connection);
}

void keep_sums(Connection& connection) {
  if (!RowSums::stored(connection)) RowSums::found(connection).write(connection);
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
