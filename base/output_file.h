#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// Outputs never destroy inputs: the one rule for every file that a program writes.

/// Records that this process reads the file; does nothing for an unreadable one. Thread-safe.
void note_input(const std::filesystem::path& file);

/// Allows writing to a file that has been read, to replace it: a calibration, for example.
void forget_input(const std::filesystem::path& file);

/// The type of a file's content, which is recognised by its beginning.
enum class FileKind { Store, Video, Picture, Pdf, Svg, WebPage, Json, Toml, Gzip, Table, Text };
FileKind kind_of(std::string_view beginning);
std::string_view name_of(FileKind kind);  ///< "a store", "a table (CSV)"

/// The path at which to write a file of this kind: the given path, or the target of its symbolic
/// links, which need not exist yet. BadInput: a file that this process has read, or an existing one
/// of another kind. Empty files, pipes and devices count as any kind.
Expected<std::filesystem::path> output_place(const std::filesystem::path& file, FileKind kind);

/// One of several outputs of a command.
struct NamedOutput {
  std::string_view option;  ///< "--csv"
  std::string file;         ///< empty: not wanted; "-": standard output
};

/// BadInput, with the later option as place, if two of the outputs are one file: the second one
/// would destroy the first. Paths are compared after links and `..`; a device such as /dev/null
/// takes any number of outputs.
Expected<void> each_its_own_file(const std::vector<NamedOutput>& outputs);

/// The Unavailable error for a file that cannot be written, with a visible cause if there is one,
/// else the system's `reason`.
Error cannot_write(const std::string& file, int reason = errno);

}  // namespace swarmsmith
