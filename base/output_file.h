#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Outputs never destroy inputs: the one rule for every file that a program writes.

/// Notes that this process reads the file; where nothing can be read, nothing happens. Any thread.
void note_input(const std::filesystem::path& file);

/// For a file that is read and then made anew, such as a calibration: it may be written.
void forget_input(const std::filesystem::path& file);

/// What a file holds, as far as its beginning tells.
enum class FileKind { Store, Video, Picture, Pdf, Svg, WebPage, Json, Toml, Gzip, Table, Text };
FileKind kind_of(std::string_view beginning);
std::string_view name_of(FileKind kind);  ///< "a store", "a table (CSV)"

/// Where a file of this kind is written: the name itself, or where its links lead, also to a file
/// that is not there yet. BadInput: a file that this process has read, or one of another kind,
/// which nobody asked to lose. Empty files, pipes and devices are of any kind.
Expected<std::filesystem::path> output_place(const std::filesystem::path& file, FileKind kind);

/// Unavailable: the file cannot be written, and why: what can be seen, else the system's `reason`.
Error cannot_write(const std::string& file, int reason = errno);

}  // namespace swarmsmith
