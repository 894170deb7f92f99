#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "irace_core/files/irace_text.h"

namespace swarmsmith::testing {

/// A text file of tests/golden/irace, under its own name.
inline IraceText golden_text(const std::string& file) {
  const std::filesystem::path path = std::string(SWARMSMITH_TEST_DATA) + "/irace/" + file;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("no golden file " + file);
  std::ostringstream text;
  text << in.rdbuf();
  return {text.str(), path.filename().string()};
}

}  // namespace swarmsmith::testing
