#pragma once

#include <cstdint>

#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// Makes the real runs in the rest of a damaged store consistent. Parts whose run is lost are
/// removed. A run that lacks parts gets one more scoring, INVALID, that names them (and that keeps
/// the score if everything from which it follows is there). A run whose candidate is lost loses its
/// candidate. Returns the number of removed rows. Throws SqliteError.
std::int64_t mend_real_runs(sqlite::Connection& connection);

}  // namespace swarmsmith
