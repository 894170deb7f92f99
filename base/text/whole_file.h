#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Whole files, read and written (base/output_file.h: outputs never destroy inputs).

/// All bytes of a file. What is missing, a folder, not to be read or larger than 64 MB is an error
/// whose place is the file.
Expected<std::string> read_whole_file(const std::filesystem::path& file);

/// The same in other words: `what` is what the file should be ("profile"), `most` its largest size
/// in bytes.
Expected<std::string> read_file(const std::filesystem::path& file, const std::string& what,
                                std::size_t most = 16U << 20U);

/// Writes a file so that its name never stands for a half of it: beside it first, then renamed,
/// over another one of its kind if there is; links stay. What is not a plain file, such as a pipe,
/// is written to as it is.
///
/// Errors: those of `output_place`, `cannot_write`; then nothing has changed.
Expected<void> write_whole_file(const std::string& file, std::string_view bytes);

}  // namespace swarmsmith
