#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// A file may contain other objects than the project's tables and views, which could change what is
/// written or read. These functions compare it with what the scripts of this program make, object
/// by object.

/// The objects of a store of this schema that are missing, foreign, or have another text: "trigger
/// negate", "table evaluation (column note added)". Views of an earlier schema are ignored, since a
/// migration makes them again, and so are SQLite's own statistics. Throws SqliteError.
std::vector<std::string> foreign_objects(const sqlite::Connection& connection, std::int64_t schema);

/// "trigger negate, table notes and 3 more".
std::string listed_objects(const std::vector<std::string>& objects);

/// Corrupt when foreign_objects finds any.
Expected<void> check_schema(const sqlite::Connection& connection,
                            const std::filesystem::path& path);

/// The check for readers, which need no other: Corrupt when one of the tables is not a table, or
/// lacks columns, or has them at other positions.
Expected<void> check_tables(const sqlite::Connection& connection,
                            const std::filesystem::path& path);

/// "a name in the store's table source has 1001 bytes; the limit is 1000" if a name or another text
/// that is read often is too long; else empty. (Names are in every table and figure.) Texts from
/// outside are checked in this way before the commit. Throws SqliteError.
std::string too_long_text(const sqlite::Connection& connection);

/// Corrupt when too_long_text finds a text. Throws SqliteError.
Expected<void> check_lengths(const sqlite::Connection& connection,
                             const std::filesystem::path& path);

/// Copies every row into the tables of `to`, which the program has made, from the tables of the
/// same names, with columns matched by name. Throws SqliteError.
void copy_rows(const sqlite::Connection& from, const sqlite::Connection& to);

}  // namespace swarmsmith
