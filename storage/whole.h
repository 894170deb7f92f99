#pragma once

#include <filesystem>

#include "base/expected.h"

namespace swarmsmith {

/// Corrupt when the rows of a store are not in the state that its last commit left: another program
/// changed them, or the store is a copy with some parts older than others. Also Corrupt when the
/// codes of candidates expand to more text than a store can have. Reads all rows, unless the file
/// is unchanged since its last writer closed it. Other errors: those of StoreReader::open.
Expected<void> check_rows(const std::filesystem::path& store);

}  // namespace swarmsmith
