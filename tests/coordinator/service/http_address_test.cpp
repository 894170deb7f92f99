#include "coordinator/service/http_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

TEST(HttpAddress, OnLoopbackOnlyItsOwnNamesAreOurs) {
  const Address here{"127.0.0.1", 8347};
  for (const char* ours : {"127.0.0.1:8347", "localhost", "LOCALHOST:1", "[::1]:8347"})
    EXPECT_TRUE(is_our_host(ours, here, "node1")) << ours;
  for (const char* other : {"", "evil.example:8347", "127.0.0.1.evil.example", "node1", "10.0.0.1",
                            "localhost.evil.example", "[::1", "localhost:8347@evil.example",
                            "localhost:http", "::1:8347"})
    EXPECT_FALSE(is_our_host(other, here, "node1")) << other;
}

TEST(HttpAddress, ElsewhereOurNameAndNumbersAreOurs) {
  const Address all{"0.0.0.0", 8347};
  for (const char* ours : {"node1:8347", "10.0.0.1:8347", "[fd00::1]:8347", "localhost:8347"})
    EXPECT_TRUE(is_our_host(ours, all, "node1")) << ours;
  EXPECT_FALSE(is_our_host("evil.example:8347", all, "node1"));
}

TEST(HttpToken, MustBeItsOwnersAloneAndLong) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& text, std::filesystem::perms mode) {
    std::ofstream(folder / "token") << text;
    std::filesystem::permissions(folder / "token", mode);
    return read_token(folder / "token");
  };
  using std::filesystem::perms;
  const perms mine = perms::owner_read | perms::owner_write;
  EXPECT_EQ(write("0123456789abcdef\n", mine).value(), "0123456789abcdef");
  EXPECT_THAT(write("0123456789abcdef\n", mine | perms::group_read).error().message,
              ::testing::HasSubstr("chmod 600"));
  EXPECT_FALSE(write("short\n", mine));
  EXPECT_FALSE(write("0123456789 abcdef\n", mine));
  EXPECT_FALSE(read_token(folder / "none"));
}

TEST(HttpToken, IsComparedWhole) {
  EXPECT_TRUE(has_token("Bearer secret", "secret"));
  for (const char* wrong :
       {"", "secret", "Bearer ", "Bearer secre", "Bearer secret2", "Basic secret"})
    EXPECT_FALSE(has_token(wrong, "secret")) << wrong;
}

}  // namespace
}  // namespace swarmsmith
