#include "base/plain_text.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(Split, GivesOnePartMoreThanThereAreSeparators) {
  EXPECT_THAT(split("a,b", ','), ElementsAre("a", "b"));
  EXPECT_THAT(split(",a,", ','), ElementsAre("", "a", ""));
  EXPECT_THAT(split("a b", ','), ElementsAre("a b"));
  EXPECT_THAT(split("", ','), ElementsAre(""));
}

TEST(SplitLines, TheLastLineMayLackItsEnd) {
  EXPECT_THAT(split_lines("a\n\nb\n"), ElementsAre("a", "", "b"));
  EXPECT_THAT(split_lines("a\nb"), ElementsAre("a", "b"));
  EXPECT_THAT(split_lines("\n"), ElementsAre(""));
  EXPECT_THAT(split_lines(""), IsEmpty());
}

TEST(Counted, OneIsOneAndAllOthersAreSeveral) {
  EXPECT_EQ(counted(1, "worker"), "1 worker");
  EXPECT_EQ(counted(0, "worker"), "0 workers");
  EXPECT_EQ(counted(std::size_t{2}, "hidden node"), "2 hidden nodes");
  EXPECT_EQ(counted(1, "patch", "patches"), "1 patch");
  EXPECT_EQ(counted(2, "patch", "patches"), "2 patches");
}

TEST(CommandWordTest, IsQuotedWhereAShellNeedsIt) {
  EXPECT_EQ(command_word("lab/arena.toml"), "lab/arena.toml");
  EXPECT_EQ(command_word("odd name/arena.toml"), "'odd name/arena.toml'");
  EXPECT_EQ(command_word("Ada's.toml"), "'Ada'\\''s.toml'");
  EXPECT_EQ(command_word(""), "''");
}

}  // namespace
}  // namespace swarmsmith
