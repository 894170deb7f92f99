#include "base/shown_text.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(ShownText, KeepsWhatIsShown) {
  for (const char* text :
       {"", "plain", "a\nb\tc", "gr\xc3\xbc\xc3\x9f \xe4\xb8\x96\xe7\x95\x8c",
        "\xf0\x9f\x90\x9d \"quoted\" \\ <b>", "\xc2\xa0\xe2\x80\xa7\xe2\x81\xaa"}) {
    EXPECT_EQ(as_shown(text), text);
  }
}

TEST(ShownText, HasEscapesForEveryControlCharacter) {
  for (int code = 0; code < 0x20; ++code) {
    const std::string shown = as_shown(std::string(1, static_cast<char>(code)), Layout::Escaped);
    EXPECT_EQ(shown.front(), '\\') << code;
    for (const char letter : shown)
      EXPECT_GE(letter, ' ');
  }
  EXPECT_EQ(as_shown(std::string_view("a\0\x1b[2J\r\x7f", 8)), "a\\u0000\\u001b[2J\\u000d\\u007f");
  EXPECT_EQ(as_shown("\xc2\x80 \xc2\x9b"
                     "31m \xc2\x9f"),
            "\\u0080 \\u009b31m \\u009f");
  EXPECT_EQ(as_shown("a\nb\tc", Layout::Escaped), "a\\nb\\tc");
}

TEST(ShownText, HasEscapesForWhatTurnsLinesAroundOrBreaksThem) {
  EXPECT_EQ(as_shown("\xd8\x9c\xe2\x80\x8e\xe2\x80\x8f"), "\\u061c\\u200e\\u200f");
  EXPECT_EQ(as_shown("\xe2\x80\xa8\xe2\x80\xaa\xe2\x80\xae"), "\\u2028\\u202a\\u202e");
  EXPECT_EQ(as_shown("\xe2\x81\xa6\xe2\x81\xa9"), "\\u2066\\u2069");
}

TEST(ShownText, HasEscapesForBytesThatAreNoText) {
  EXPECT_EQ(as_shown("\x9b"
                     "31m\xff"),
            "\\x9b31m\\xff");
  EXPECT_EQ(as_shown("\xc3"), "\\xc3");
  EXPECT_EQ(as_shown("\xc0\x9b"), "\\xc0\\x9b");                             // overlong
  EXPECT_EQ(as_shown("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");                    // overlong
  EXPECT_EQ(as_shown("\xed\xa0\x80"), "\\xed\\xa0\\x80");                    // half of a pair
  EXPECT_EQ(as_shown("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");           // beyond the last
  EXPECT_EQ(as_shown("\xf8\x88\x80\x80\x80"), "\\xf8\\x88\\x80\\x80\\x80");  // five bytes
}

}  // namespace
}  // namespace swarmsmith
