#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith::cli {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256_of(std::string_view bytes);

/// The same of a file of any length, piece by piece; of a folder, over the names and digests of the
/// files in it, by name. `on_bytes` hears now and then how many were read. BadInput for what cannot
/// be read.
Expected<std::string> sha256_of_recording(const std::filesystem::path& path,
                                          const std::function<void(std::int64_t)>& on_bytes = {});

}  // namespace swarmsmith::cli
