#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What stands in a file beside our tables and views is not ours: it could change what is written
/// or read. Compared with what the scripts of this program make, object by object.

/// The objects of a store of this schema that are missing, not ours, or of another text: "trigger
/// negate", "table evaluation (column note added)". Views of an earlier schema than ours are left
/// out, since a migration makes them anew, and so are SQLite's own statistics. Throws SqliteError.
std::vector<std::string> foreign_objects(const sqlite::Connection& connection, std::int64_t schema);

/// "trigger negate, table notes and 3 more".
std::string listed_objects(const std::vector<std::string>& objects);

/// Corrupt when foreign_objects finds some.
Expected<void> check_schema(const sqlite::Connection& connection,
                            const std::filesystem::path& path);

/// For readers, which need nothing else: Corrupt when one of our tables is none, or lacks
/// columns, or has them in other places.
Expected<void> check_tables(const sqlite::Connection& connection,
                            const std::filesystem::path& path);

/// Corrupt when a name, which stands in every table and figure, or a text that is read again and
/// again is longer than any of ours. Throws SqliteError.
Expected<void> check_lengths(const sqlite::Connection& connection,
                             const std::filesystem::path& path);

/// Every row of the tables of `to`, which are ours, from those of the same names, column by column
/// by their names. Throws SqliteError.
void copy_rows(const sqlite::Connection& from, const sqlite::Connection& to);

}  // namespace swarmsmith
