#pragma once

#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// How a store recognises its own file. What its last writer closed it remembers by inode, birth
/// and time of change; a copy, a file that another program has written since, and one whose writer
/// was killed, are others, and are checked as a whole before they are written on.

/// Folds the log into the file and remembers the file, as the last thing that is done with it.
/// Where that fails, the next writer checks. Before, all is on disk already.
void close_file(sqlite::Connection& connection);

/// Whether the file is the one that was closed, as it was closed, without a log beside it. Throws
/// SqliteError.
bool is_as_closed(const sqlite::Connection& connection);

}  // namespace swarmsmith
