#pragma once

#include "storage/internal/sqlite.h"
#include "storage/store.h"

namespace swarmsmith {

/// Runs a user's statement; see StoreReader::query. While it runs, the connection allows only
/// reading: it refuses writes, ATTACH, transactions, and settings that a PRAGMA would change.
Expected<StoreReader::QueryEnd> run_query(
    sqlite::Connection& connection, const std::string& sql, const StoreReader::QueryLimits& limits,
    const std::function<void(const std::vector<std::string>&)>& on_columns,
    const std::function<void(const std::vector<StoreReader::Cell>&)>& on_row);

}  // namespace swarmsmith
