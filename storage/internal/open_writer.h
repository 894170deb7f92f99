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

/// What every writer of a store begins with, whatever it is going to write.

/// A store that is open for writing. What is declared last is given up first: the file while SQLite
/// still has it open, then SQLite's handle, then the name.
struct Writer {
  LockFile lock;
  sqlite::Connection connection;
  HeldFile file;
  /// PRAGMA data_version before anything was looked at: changes when another connection commits.
  std::int64_t data_version = 0;
  bool is_lost = false;  ///< the file; nothing more can be done with it
};

/// Takes the locks and opens the file for writing, or makes an empty one: ours or blank, of any
/// schema up to this program's with nothing else in it, in WAL mode, the only name of its file.
/// After an unclean end its log is folded in; then, and when the file is not the one that was
/// closed, all of it is checked. Until the caller trusts a file that was not closed, its lock is
/// suspect. `path` without links (real_store). Changes no content. Errors as of Store::open. Throws
/// SqliteError.
Expected<Writer> open_writer(const std::filesystem::path& path, std::chrono::milliseconds patience);

/// What became of a store whose file has met its fate (HeldFile::fate).
struct Lost {
  bool saved = false;  ///< all that was committed is in another file
  Error error;         ///< what happened, where the rest is, what to do; of the kind Conflict
};

/// Saves what was committed, and leaves the rest as it is.
Lost save_lost(Writer& writer, const std::string& fate);

/// Before it is closed: folds the log into the file, which only tidies up, since what was committed
/// is on disk; or saves it, when the file was lost at the last moment.
void give_up(Writer& writer);

/// Tables, views and where the file was made, in a blank file; the caller holds a transaction.
void write_empty_store(sqlite::Connection& connection);

/// Sums over the rows (RowSums), in a store that has none yet. Throws SqliteError.
void keep_sums(sqlite::Connection& connection);

/// A store of a schema before 4 does not say in which flavour its machines are written: takes it
/// from these designs.
void name_flavours(sqlite::Connection& connection, const std::vector<DesignRow>& designs);

/// The error that a failure while opening stands for: Corrupt or Unavailable.
Unexpected not_writable(const sqlite::SqliteError& error, const std::filesystem::path& path);

}  // namespace swarmsmith
