#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "base/expected.h"
#include "storage/internal/lock_file.h"
#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What every writer of a store begins with, whatever it is going to write.

/// The right to write, and whether the last writer did not end well.
struct WriterLock {
  LockFile file;
  bool unclean = false;
};

/// Takes the lock, which is suspect as long as an unclean store has not been looked at, and looks
/// at the file from outside. Errors as of Store::open.
Expected<WriterLock> lock_for_writing(const std::filesystem::path& path,
                                      std::chrono::milliseconds patience);

/// Opens the file for writing, or makes an empty one: ours or blank, of any schema up to this
/// program's, in WAL mode; when `unclean`, its log is folded in and every page checked. Changes no
/// content. Throws SqliteError.
Expected<sqlite::Connection> connect_writer(const std::filesystem::path& path, bool unclean);

/// Tables, views and where the file was made, in a blank file; the caller holds a transaction.
void write_empty_store(sqlite::Connection& connection);

/// A store of a schema before 4 does not say in which flavour its machines are written: takes it
/// from these designs.
void name_flavours(sqlite::Connection& connection, const std::vector<DesignRow>& designs);

/// The error that a failure while opening stands for: Corrupt or Unavailable.
Unexpected not_writable(const sqlite::SqliteError& error, const std::filesystem::path& path);

}  // namespace swarmsmith
