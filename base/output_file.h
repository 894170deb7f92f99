#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Outputs never destroy inputs: the one rule for every file that a program writes.

/// Records that this process reads the file; does nothing for an unreadable one. Any thread.
void note_input(const std::filesystem::path& file);

/// Allows writing a file that is read and then replaced, such as a calibration.
void forget_input(const std::filesystem::path& file);

/// The kind of a file's content, judged by its beginning.
enum class FileKind { Store, Video, Picture, Pdf, Svg, WebPage, Json, Toml, Gzip, Table, Text };
FileKind kind_of(std::string_view beginning);
std::string_view name_of(FileKind kind);  ///< "a store", "a table (CSV)"

/// Where a file of this kind is written: the name itself, or where its links lead, also to a file
/// that does not exist yet. BadInput: a file that this process has read, or an existing one of
/// another kind. Empty files, pipes and devices count as any kind.
Expected<std::filesystem::path> output_place(const std::filesystem::path& file, FileKind kind);

/// Unavailable: the file cannot be written, and why: what can be seen, else the system's `reason`.
Error cannot_write(const std::string& file, int reason = errno);

}  // namespace swarmsmith
