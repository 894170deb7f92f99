#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// The access that other users may have to a file. The files of access/ are read only if others
/// have no more access than this.
enum class Privacy {
  Secret,    ///< only its owner may read or write it
  Integral,  ///< others may read it, but not write it
};

/// The content of a file of this user, at most 1 MB. Errors name the file and never show its
/// content: it does not exist, is not a file, belongs to another user, or is open to others (with
/// the chmod command that corrects it).
Expected<std::string> read_private_file(const std::filesystem::path& file, const std::string& what,
                                        Privacy privacy);

/// Makes a new file with mode 0600; Conflict when it exists.
Expected<void> write_new_file(const std::filesystem::path& file, std::string_view text);

/// Makes the file, or replaces it in one step (rename), with this mode: a reader sees either the
/// old text or the new one.
Expected<void> replace_file(const std::filesystem::path& file, std::string_view text,
                            unsigned mode);

}  // namespace swarmsmith
