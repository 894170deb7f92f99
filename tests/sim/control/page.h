#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace swarmsmith {

/// A page of docs/, which a test compares with the data that it tells of.
inline std::string page_text(const std::string& name) {
  std::ifstream stream(std::string(SWARMSMITH_SOURCE_DIR) + "/docs/" + name);
  EXPECT_TRUE(stream.good()) << "no page " << name;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A number as a page has it: 0.4, 16000, "none" for infinity.
inline std::string short_text(double value) {
  if (std::isinf(value)) return "none";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

}  // namespace swarmsmith
