#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// Looks at a store before SQLite reads it, since SQLite's own words ("database disk
/// image is malformed") say neither what is wrong nor what to do.

/// "the store is damaged: FAULT; take it from a backup, or ..."
std::string damaged_text(const std::string& fault);

/// Whether it begins as SQLite's files do.
bool has_database_header(const sqlite::Connection& connection);

/// Corrupt when the file of a fresh connection does not begin as a SQLite database does, or is
/// shorter than its header says (unless a write-ahead log lies beside it, which may hold the rest).
/// An empty file passes. `path` is what people call it. Throws SqliteError.
Expected<void> check_database_file(const sqlite::Connection& connection,
                                   const std::filesystem::path& path);

/// BadInput when the folder does not exist, or lies on a file system that hosts share: there
/// SQLite's shared memory and locks do not work, and two writers would destroy the store. The
/// environment variable SWARMSMITH_ALLOW_NETWORK_FS=1 lets it pass.
Expected<void> check_folder(const std::filesystem::path& store);

/// What a file system is that hosts may share; empty where it is this host's alone. `type` is
/// statfs's f_type, `name` that of mountinfo ("nfs4", "fuse.sshfs"), empty if it is not known. FUSE
/// has one f_type for all programs behind it: those that only show a local folder or disk in
/// another form are local, and what is not known is not.
std::string kind_of_shared(long type, std::string_view name);

/// The same of a file or folder. A FUSE file system that shows another folder (bindfs, gocryptfs)
/// is what that folder's is.
std::string shared_file_system(const std::filesystem::path& path);

/// A write-ahead log with something in it lies beside the store: its last writer did not end well,
/// or is at work.
bool has_pending_log(const std::filesystem::path& store);

}  // namespace swarmsmith
