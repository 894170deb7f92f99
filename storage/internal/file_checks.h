#pragma once

#include <filesystem>
#include <string>

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

/// BadInput when the folder does not exist, or lies on a file system shared between hosts: there
/// SQLite's shared memory and locks do not work, and two writers would destroy the store. The
/// environment variable SWARMSMITH_ALLOW_NETWORK_FS=1 lets it pass.
Expected<void> check_folder(const std::filesystem::path& store);

/// Whether a file system of this type (statfs's f_type) is shared between hosts.
bool is_network_file_system(long type);

/// A write-ahead log with something in it lies beside the store: its last writer did not end well,
/// or is at work.
bool has_pending_log(const std::filesystem::path& store);

}  // namespace swarmsmith
