#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Corrupt when the rows of a store are not those of one commit, since another program changed
/// them, or since it is a copy of which some parts are older than others. Reads all rows, unless
/// the file is as its last writer closed it. For those who make numbers of them. The errors of
/// StoreReader::open are left to it.
Expected<void> check_rows(const std::filesystem::path& store);

/// In this process, says in a sentence when a store takes longer than two seconds to be checked as
/// a whole, before it is written. Called by the thread that opens it.
void set_check_listener(std::function<void(const std::string&)> on_long_check);

/// Characters of a name in a store: of campaigns, missions, methods, designs, sources.
inline constexpr std::int64_t kLongestName = 1000;

}  // namespace swarmsmith
