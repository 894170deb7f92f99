#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// Checks on a store before SQLite reads it, since SQLite's own messages ("database disk image is
/// malformed") say neither what is wrong nor what to do.

/// "the store is damaged: FAULT; take it from a backup, or ..."
std::string damaged_text(const std::string& fault);

/// Whether the file begins as SQLite's files do.
bool has_database_header(const sqlite::Connection& connection);

/// Corrupt when the file of a fresh connection does not begin as an SQLite database does, or is
/// shorter than its header says (unless a write-ahead log is beside it, which may have the rest).
/// An empty file passes. `path` is the name for messages. Throws SqliteError.
Expected<void> check_database_file(const sqlite::Connection& connection,
                                   const std::filesystem::path& path);

/// BadInput when the folder does not exist, or is on a file system that hosts share: SQLite's
/// shared memory and locks do not work there, and two writers would destroy the store. The
/// environment variable SWARMSMITH_ALLOW_NETWORK_FS=1 allows such a file system.
Expected<void> check_folder(const std::filesystem::path& store);

/// The kind of a file system that hosts may share; empty if only this host uses it. `type` is
/// statfs's f_type; `name` is its name in mountinfo ("nfs4", "fuse.sshfs"), empty if unknown. FUSE
/// has one f_type for all its file systems: those that only show a local folder or disk in another
/// form are local, and unknown ones count as shared.
std::string kind_of_shared(long type, std::string_view name);

/// The same for a file or folder. A FUSE file system that shows another folder (bindfs, gocryptfs)
/// has the kind of that folder's file system.
std::string shared_file_system(const std::filesystem::path& path);

/// Whether there is a write-ahead log with content beside the store: its last writer did not end
/// cleanly, or is still running.
bool has_pending_log(const std::filesystem::path& store);

}  // namespace swarmsmith
