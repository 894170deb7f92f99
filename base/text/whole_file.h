#pragma once

#include <filesystem>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// All bytes of a file. What is missing, a folder, not to be read or larger than 64 MB is an error
/// whose place is the file.
Expected<std::string> read_whole_file(const std::filesystem::path& file);

}  // namespace swarmsmith
