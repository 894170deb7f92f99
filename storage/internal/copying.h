#pragma once

#include <filesystem>

#include "storage/backup.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What back_up does, into a file that need not have its last name; nothing is there yet.
Expected<Backup> copy_store(const std::filesystem::path& store, const std::filesystem::path& to,
                            const OnCopied& on_copied);

/// The error of a store that cannot be read through: what was found, and that `recover` takes the
/// rest.
Unexpected damaged(const std::filesystem::path& store, const std::string& fault);

/// What an exception of SQLite means to the user who made `to` out of `from`.
Unexpected copying_failed(const sqlite::SqliteError& error, const std::filesystem::path& from,
                          const std::filesystem::path& to);

}  // namespace swarmsmith
