#include "storage/backup.h"

#include <fmt/format.h>

#include "storage/internal/copying.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/new_file.h"
#include "storage/internal/reading.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/schema.h"
#include "storage/internal/schema_check.h"
#include "storage/store.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::SqliteError;

/// Copies all pages of a database into an empty one. The source's transaction must be open: it
/// fixes the state that is copied, even if the store is written meanwhile.
void copy_pages(const Connection& from, const Connection& to, const OnCopied& on_copied) {
  constexpr int kPagesAtOnce = 512;
  sqlite3_backup* copying = sqlite3_backup_init(to.handle(), "main", from.handle(), "main");
  if (copying == nullptr) to.fail(sqlite3_extended_errcode(to.handle()));
  int code = SQLITE_OK;
  while (code == SQLITE_OK) {
    code = sqlite3_backup_step(copying, kPagesAtOnce);
    const std::int64_t all = sqlite3_backup_pagecount(copying);
    on_copied(all - sqlite3_backup_remaining(copying), all);
  }
  sqlite3_backup_finish(copying);
  if (code != SQLITE_DONE) to.fail(code, sqlite3_errstr(code));
}

/// Copies all rows of the store's own tables into an empty database, without any other objects of
/// the file.
void copy_our_rows(const Connection& from, Connection& to, std::int64_t schema) {
  sqlite::Transaction transaction(to);
  create_tables(to, schema);
  copy_rows(from, to);
  finish_schema(to, schema);
  transaction.commit();
}

}  // namespace

Unexpected damaged(const fs::path& store, const std::string& fault) {
  return unexpected(ErrorKind::Corrupt, damaged_text(fault), store.string());
}

Unexpected copying_failed(const SqliteError& error, const fs::path& from, const fs::path& to) {
  const int code = error.primary_code();
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) return damaged(from, error.what());
  return unexpected(ErrorKind::Unavailable, fmt::format("cannot be written: {}", error.what()),
                    to.string());
}

Expected<Backup> copy_store(const fs::path& store, const fs::path& to, const OnCopied& on_copied) {
  // Gives the error for a file that is not a store, or a newer one.
  if (const auto reader = StoreReader::open(store); !reader) return Unexpected(reader.error());
  Backup made;
  try {
    auto connected = connect_for_reading(store);
    if (!connected) return Unexpected(connected.error());
    Connection& original = *connected;
    const ReadTransaction snapshot(original);
    const std::int64_t schema = schema_of(original);  // the snapshot begins with the first reading
    Connection copy(to.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    const bool is_ours = foreign_objects(original, schema).empty();
    if (is_ours) {
      copy_pages(original, copy, on_copied);
      configure_writer(copy);
    } else {
      configure_writer(copy);
      copy.execute("PRAGMA foreign_keys = OFF");
      copy_our_rows(original, copy, schema);
    }
    // A migration counts the rows again.
    if (const std::string changed = schema == kSchemaVersion ? "" : changed_rows(copy);
        !changed.empty()) {
      return damaged(store, changed);
    }
    upgrade(copy, migrations());
    forget_secret(copy);  // copies may be given to others while the campaign still runs
    if (const auto faults = faults_of(copy); !faults.empty()) return damaged(store, faults.front());
    const ReadTransaction of_copy(copy);
    made.digest = digest_of_store(copy);
    if (made.digest != digest_of_store(original)) {
      return damaged(store, "what was read and what was copied differ");
    }
    made.schema = schema_of(copy);
    if (schema != made.schema) made.migrated = schema;
  } catch (const SqliteError& error) {
    return copying_failed(error, store, to);
  }
  std::error_code ignored;
  made.bytes = static_cast<std::int64_t>(fs::file_size(to, ignored));
  return made;
}

Expected<Backup> back_up(const fs::path& store, const fs::path& copy, const OnCopied& on_copied) {
  auto file = NewFile::beside(copy);
  if (!file) return Unexpected(file.error());
  auto made = copy_store(store, file->path(), on_copied);
  if (!made) {
    // The temporary name means nothing to users.
    if (made.error().where == file->path().string()) made.error().where = copy.string();
    return made;
  }
  if (auto published = file->publish(); !published) return Unexpected(published.error());
  return made;
}

}  // namespace swarmsmith
