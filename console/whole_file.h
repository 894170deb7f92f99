#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith::cli {

/// Writes a file so that its name never stands for a half of it: beside it first, then renamed,
/// over another one of its kind if there is; links stay. What is no plain file, such as a pipe, is
/// written to as it is.
///
/// Errors: those of `output_place`, `cannot_write`; then nothing has changed.
Expected<void> write_whole_file(const std::string& file, std::string_view bytes);

}  // namespace swarmsmith::cli
