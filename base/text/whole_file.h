#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Functions to read and write whole files (base/output_file.h: outputs never destroy inputs).

/// All bytes of a file. It is an error, with the file as its place, if the file is missing, a
/// folder, unreadable or larger than 64 MB.
Expected<std::string> read_whole_file(const std::filesystem::path& file);

/// The same with other messages: `what` is what the file should be ("profile"), `most` its largest
/// size in bytes.
Expected<std::string> read_file(const std::filesystem::path& file, const std::string& what,
                                std::size_t most = 16U << 20U);

/// Writes a file so that its name never leads to an incomplete one: it is written beside its final
/// place, then renamed, replacing an existing file of its kind; symbolic links are kept. Anything
/// that is not a regular file, such as a pipe, is written directly.
///
/// Errors: those of `output_place`, `cannot_write`; then nothing has changed.
Expected<void> write_whole_file(const std::string& file, std::string_view bytes);

}  // namespace swarmsmith
