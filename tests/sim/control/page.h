#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {

/// A page of docs/, which a test compares with the data that it tells of.
inline std::string page_text(const std::string& name) {
  return whole_file(SWARMSMITH_SOURCE_DIR "/docs/" + name);
}

/// A number as a page has it: 0.4, 16000, "none" for infinity.
inline std::string short_text(double value) {
  if (std::isinf(value)) return "none";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

}  // namespace swarmsmith
