#pragma once

#include <cstdint>

#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// Makes whole runs of what a damaged store has left of its real runs: parts whose run is lost go;
/// a run that lacks parts gets one more scoring, INVALID, that says which (with the score as it was
/// when all that it follows from is there); a lost candidate is forgotten. Returns how many rows
/// went. Throws SqliteError.
std::int64_t mend_real_runs(sqlite::Connection& connection);

}  // namespace swarmsmith
