#include "console/terminal.h"

#include <gtest/gtest.h>
#include <sstream>

namespace swarmsmith {
namespace {

/// What a terminal gets of what was written.
class Screens : public ::testing::Test {
 protected:
  std::string shown() { return behind_.str(); }

  std::ostringstream behind_;
  ShownBuffer buffer_{behind_.rdbuf()};
  std::ostream stream_{&buffer_};
  Output output_{.out = stream_, .err = stream_};
};

TEST_F(Screens, ShowTextOfAnyWriter) {
  stream_ << "host a\x1b]0;mine\x07" << 7 << '\x9b' << "x\n";
  EXPECT_EQ(shown(), "host a\\u001b]0;mine\\u00077\\x9bx\n");
}

TEST_F(Screens, PutCharactersTogetherThatComeInPieces) {
  for (const char byte : std::string("\xe4\xb8\x96 \xc2\x9b \xf0\x9f\x90\x9d"))
    stream_ << byte;
  EXPECT_EQ(shown(), "\xe4\xb8\x96 \\u009b \xf0\x9f\x90\x9d");
  stream_ << "\xe4\xb8" << std::flush << "a\xe4" << kClearLine;
  EXPECT_TRUE(shown().ends_with("\\xe4\\xb8a\\xe4\r\x1b[2K"));
}

TEST_F(Screens, ObeyTheProgramItself) {
  stream_ << kClearLine << "a" << Verbatim{"\x1b[K"} << "\n";
  EXPECT_EQ(shown(), "\r\x1b[2Ka\x1b[K\n");
}

TEST_F(Screens, GetDataAsTextAndOthersGetThemExactly) {
  const std::string data("PNG\r\n\x1a\0\xff", 8);
  write_data(output_, data);
  EXPECT_EQ(shown(), data);
  output_.out_is_terminal = true;
  write_data(output_, "\x1b[2J");
  EXPECT_EQ(shown(), data + "\\u001b[2J");
}

TEST_F(Screens, ShowErrorsOfWhichNoLineLooksLikeAnother) {
  print_error(output_, {ErrorKind::BadInput, "has no key `a\nb`\n", "a\nswarmsmith: all is well"});
  EXPECT_EQ(shown(), "swarmsmith: a\\nswarmsmith: all is well: has no key `a\n  b`\n");
}

TEST_F(Screens, SayWhenNothingCanBeWritten) {
  std::stringbuf read_only(std::ios::in);
  ShownBuffer buffer(&read_only);
  std::ostream stream(&buffer);
  stream << "text";
  EXPECT_FALSE(stream.good());
  std::ostream other(&buffer);
  other << kClearLine;
  EXPECT_FALSE(other.good());
}

}  // namespace
}  // namespace swarmsmith
