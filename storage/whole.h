#pragma once

#include <filesystem>

#include "base/expected.h"

namespace swarmsmith {

/// Corrupt when the rows of a store are not those of one commit, since another program changed
/// them, or since it is a copy of which some parts are older than others, or when codes of
/// candidates make more text than a store's. Reads all rows, unless the file is as its last writer
/// closed it. For those who make numbers of them. The errors of StoreReader::open are left to it.
Expected<void> check_rows(const std::filesystem::path& store);

}  // namespace swarmsmith
