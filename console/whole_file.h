#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith::cli {

/// Writes a file so that its name never leads to a half-written one: writes beside it, then
/// renames, also over an existing file of its kind; links stay. A pipe or device is written to
/// directly.
///
/// Errors: those of `output_place`, `cannot_write`; then nothing has changed.
Expected<void> write_whole_file(const std::string& file, std::string_view bytes);

}  // namespace swarmsmith::cli
