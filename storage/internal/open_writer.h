#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/expected.h"
#include "storage/internal/held_file.h"
#include "storage/internal/lock_file.h"
#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// The first steps of every writer of a store, whatever it is going to write.

/// A store that is open for writing. The members are released in reverse order: the file while
/// SQLite still has it open, then SQLite's handle, then the name.
struct Writer {
  LockFile lock;
  sqlite::Connection connection;
  HeldFile file;
  /// PRAGMA data_version from before any check; it changes when another connection commits.
  std::int64_t data_version = 0;
  bool is_lost = false;  ///< the file is lost; nothing more can be done with it
};

/// Takes the locks and opens the file for writing, or makes an empty one. The file is blank or a
/// store, of any schema up to this program's, with no foreign objects in it, in WAL mode, and has
/// only one name. After an unclean end its log is moved into the file. In that case, and when the
/// file is not as its last writer closed it, all of it is checked. The lock is suspect until the
/// caller trusts a file that was not closed. `path` must have no symbolic links (real_store).
/// Changes no rows. Errors: those of Store::open. Throws SqliteError.
Expected<Writer> open_writer(const std::filesystem::path& path, std::chrono::milliseconds patience);

/// The result of saving a store that has lost its file (HeldFile::fate).
struct Lost {
  bool saved = false;  ///< all committed rows are in another file
  Error error;         ///< what happened, where the rows are, what to do; of the kind Conflict
};

/// Saves everything that was committed, and does not change the lost file.
Lost save_lost(Writer& writer, const std::string& fate);

/// The last step before closing: moves the log into the file, which is only for tidiness, since all
/// committed rows are on disk; or saves them, if the file was lost at the last moment.
void give_up(Writer& writer);

/// Writes tables, views and the file's origin (write_maker) into a blank file; the caller holds a
/// transaction.
void write_empty_store(sqlite::Connection& connection);

/// Computes the sums over the rows (RowSums) in a store that does not have them yet. Throws
/// SqliteError.
void keep_sums(sqlite::Connection& connection);

/// A store of a schema before 4 does not name the flavour of its machines: this takes it from
/// `designs`.
void name_flavours(sqlite::Connection& connection, const std::vector<DesignRow>& designs);

/// The error for a failure while opening: Corrupt or Unavailable.
Unexpected not_writable(const sqlite::SqliteError& error, const std::filesystem::path& path);

}  // namespace swarmsmith
