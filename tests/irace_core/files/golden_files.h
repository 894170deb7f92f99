#pragma once

#include <filesystem>
#include <string>

#include "irace_core/files/irace_text.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::testing {

/// A text file of tests/golden/irace, under its own name.
inline IraceText golden_text(const std::string& file) {
  const std::filesystem::path path = std::string(SWARMSMITH_TEST_DATA) + "/irace/" + file;
  return {whole_file(path), path.filename().string()};
}

}  // namespace swarmsmith::testing
