#include "base/base64.h"

#include <gtest/gtest.h>

#include <string>

namespace swarmsmith {
namespace {

TEST(Base64, ReadsBackAnyBytesAndKnowsItsExamples) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64_text("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_text("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_text("foob"), "Zm9vYg==");
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(bytes_from_base64(base64_text(bytes)), bytes);
    bytes += static_cast<char>(i * 7);
  }
  EXPECT_FALSE(bytes_from_base64("ab$d"));
}

}  // namespace
}  // namespace swarmsmith
