#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/expected.h"
#include "base/text/table_reader.h"

namespace swarmsmith {

/// The bytes of a file. Errors name the file: not there, a folder, cannot be read, longer than
/// `most` bytes. `what` is what it should be ("profile").
Expected<std::string> read_file(const std::filesystem::path& file, const std::string& what,
                                std::size_t most = 16U << 20U);

/// Whether a word that could be a name is meant as a file: it ends in .toml or has a slash.
bool names_a_file(const std::string& word);

/// Files begin with `format = 1`; one of a later format is refused before its unknown keys confuse
/// anybody.
void read_format(TableReader& root);

}  // namespace swarmsmith
