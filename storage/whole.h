#pragma once

#include <filesystem>

#include "base/expected.h"

namespace swarmsmith {

/// Corrupt when the rows of a store are not those of one commit: another program changed them, or
/// the store is a copy, and some of its parts are older than others. Corrupt, too, when codes of
/// candidates make more text than a store's. Reads all rows, unless the file is as its last writer
/// closed it. StoreReader::open has the other errors.
Expected<void> check_rows(const std::filesystem::path& store);

}  // namespace swarmsmith
