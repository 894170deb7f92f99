#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256_of(std::string_view bytes);

/// The same for a file, which may be larger than the memory. For a folder, the hash covers the
/// lines that `sha256sum *` prints in it: the names and hashes of its files in the order of their
/// names, without hidden files and subfolders. NotFound when it does not exist, Unavailable when it
/// cannot be read.
Expected<std::string> sha256_of_file(const std::string& path);

}  // namespace swarmsmith
