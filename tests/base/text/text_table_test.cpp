#include "base/text/text_table.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(TextTable, AlignsCharactersNotBytes) {
  EXPECT_EQ(aligned({.aligns = {Align::Left},
                     .rows = {{"name", "n"}, {"\xc3\xa9t\xc3\xa9", "12"}, {"b", "3"}}}),
            "name   n\n"
            "\xc3\xa9t\xc3\xa9   12\n"
            "b      3\n");
}

TEST(TextTable, HasNoBlanksAtTheEndsOfLines) {
  EXPECT_EQ(aligned({.aligns = {Align::Left, Align::Left}, .rows = {{"a", "long"}, {"b", ""}}}),
            "a  long\nb\n");
}

TEST(TextTable, ShowsWhatWouldSteerATerminal) {
  EXPECT_EQ(aligned({.aligns = {Align::Left}, .rows = {{"a\x1b[2Jb"}}}), "a\\u001b[2Jb\n");
}

TEST(TextTable, PadsUpToAWidth) {
  EXPECT_EQ(padded("ab", 4, Align::Right), "  ab");
  EXPECT_EQ(padded("ab", 4, Align::Left), "ab  ");
  EXPECT_EQ(padded("abcde", 4, Align::Left), "abcde");
}

}  // namespace
}  // namespace swarmsmith
