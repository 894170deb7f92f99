#pragma once

#include <string>

namespace swarmsmith {

/// The name of an SQLite VFS for `database` that is SQLite's own, but makes temporary files (large
/// sorts, rollbacks of a statement) in the database's folder: there is room for the store, while
/// /tmp may be small, in memory, or full. Null where SQLite shall choose: this user cannot make
/// files there, the environment has SQLITE_TMPDIR, another VFS is the process's default, or it is
/// not a file.
const char* vfs_that_spills_beside(const std::string& database);

}  // namespace swarmsmith
