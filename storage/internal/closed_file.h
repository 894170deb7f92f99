#pragma once

#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// How a store recognises its own file. When the last writer closes the file, it stores the file's
/// inode, birth time and modification time in it. A copy, a file that another program has changed
/// since then, and a file whose writer was killed do not match, and are checked completely before
/// they are written again.

/// Moves the log into the file and stores the file's identity, as the last step of a writer. If
/// that fails, the next writer checks the file. All rows are on disk before the call.
void close_file(sqlite::Connection& connection);

/// Whether the file is unchanged since its writer closed it, without a log beside it. Throws
/// SqliteError.
bool is_as_closed(const sqlite::Connection& connection);

}  // namespace swarmsmith
