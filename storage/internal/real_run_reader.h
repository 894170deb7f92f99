#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "storage/internal/row_reader.h"
#include "storage/internal/sqlite.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// Reads real runs from their tables. The functions throw SqliteError. A store before schema 5 has
/// no runs.

/// The runs by id; only those whose candidate is in the part, with the ids that the candidates have
/// there.
std::vector<RealRunHead> read_real_runs(const sqlite::Connection& connection,
                                        const Part& part = {});

/// Empty when there is no such run.
std::optional<RealRunRows> read_real_run(const sqlite::Connection& connection, RealRunId id);

std::optional<RealRunId> real_run_of_key(const sqlite::Connection& connection,
                                         std::string_view key);

/// Faults that no key of SQLite can find: runs without a score, runs that name calibrations which
/// the store lacks, or runs with missing parts. One sentence per fault.
std::vector<std::string> faults_of_real_runs(const sqlite::Connection& connection);

}  // namespace swarmsmith
