#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256_of(std::string_view bytes);

/// The same of a file, which may be larger than the memory. Of a folder: of the lines that
/// `sha256sum *` prints in it, that is of its files' names and bytes in the order of their names,
/// without hidden files and folders. NotFound when it does not exist, Unavailable when it cannot be
/// read.
Expected<std::string> sha256_of_file(const std::string& path);

}  // namespace swarmsmith
