#pragma once

#include <filesystem>

#include "storage/backup.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// Does the work of back_up, but into a file that may get its final name later; the file does not
/// exist yet.
Expected<Backup> copy_store(const std::filesystem::path& store, const std::filesystem::path& to,
                            const OnCopied& on_copied);

/// The error for a store that cannot be read completely: the fault, and the advice to use `recover`
/// for the rest.
Unexpected damaged(const std::filesystem::path& store, const std::string& fault);

/// The error for the user who was copying `from` to `to` when SQLite threw an exception.
Unexpected copying_failed(const sqlite::SqliteError& error, const std::filesystem::path& from,
                          const std::filesystem::path& to);

}  // namespace swarmsmith
