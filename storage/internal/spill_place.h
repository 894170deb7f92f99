#pragma once

#include <string>

namespace swarmsmith {

/// The name of an SQLite VFS for `database`. It is SQLite's own VFS, but makes temporary files
/// (large sorts, rollbacks of a statement) in the database's folder: the disk of the store has
/// room, while /tmp may be small, in memory, or full. Null where SQLite's own choice is used: this
/// user cannot make files in the folder, the environment has SQLITE_TMPDIR, another VFS is the
/// process's default, or `database` is not a file.
const char* vfs_that_spills_beside(const std::string& database);

}  // namespace swarmsmith
