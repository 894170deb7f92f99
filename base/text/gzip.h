#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// The bytes as a gzip file without name and time, so that the same bytes give the same file.
/// `level` from 1 (fast) to 9 (small).
std::string gzip(std::string_view bytes, int level = 6);

/// The bytes before packing. Corrupt when it is not a gzip file, or unpacks to more than `most`
/// bytes.
Expected<std::string> gunzip(std::string_view packed, std::size_t most);

}  // namespace swarmsmith
