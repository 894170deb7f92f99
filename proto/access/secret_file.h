#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Who else may do what with a file; the files of access/ are read only when it is not more than
/// this.
enum class Privacy {
  Secret,    ///< only its owner may read or write it
  Integral,  ///< others may read it, not write it
};

/// The bytes of a file of this user, at most 1 MB. Errors name the file and never show what is in
/// it: not there, no file, another user's, open to others (with the chmod that mends it).
Expected<std::string> read_private_file(const std::filesystem::path& file, const std::string& what,
                                        Privacy privacy);

/// Makes a file with mode 0600 that was not there; Conflict when it is.
Expected<void> write_new_file(const std::filesystem::path& file, std::string_view text);

/// Makes the file, or puts the new one in its place in one step (rename), with this mode: a reader
/// sees the old text or the new one.
Expected<void> replace_file(const std::filesystem::path& file, std::string_view text,
                            unsigned mode);

}  // namespace swarmsmith
