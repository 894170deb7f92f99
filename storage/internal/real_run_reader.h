#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "storage/internal/row_reader.h"
#include "storage/internal/sqlite.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// Real runs out of their tables. Throw SqliteError. A store before schema 5 has none.

/// By id; those whose candidate is in the part, with the ids that it has there.
std::vector<RealRunHead> read_real_runs(const sqlite::Connection& connection,
                                        const Part& part = {});

/// Nothing when there is no such run.
std::optional<RealRunRows> read_real_run(const sqlite::Connection& connection, RealRunId id);

std::optional<RealRunId> real_run_of_key(const sqlite::Connection& connection,
                                         std::string_view key);

/// What no key of SQLite's can say: runs without a score, that name calibrations which the store
/// lacks, or whose parts are not all there. A sentence a fault.
std::vector<std::string> faults_of_real_runs(const sqlite::Connection& connection);

}  // namespace swarmsmith
