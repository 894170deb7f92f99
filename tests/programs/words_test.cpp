#include "programs/words.h"

#include "base/process/interrupt.h"
#include "base/process/process.h"
#include "base/rng.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Texts = std::vector<std::string>;

Texts words(std::string_view text) {
  const auto split = split_words(text);
  EXPECT_TRUE(split && !split->needs_shell) << text;
  return split ? split->words : Texts{};
}

std::optional<char> shell_for(std::string_view text) {
  const auto split = split_words(text);
  return split ? split->needs_shell : std::nullopt;
}

TEST(Words, AreSeparatedByBlanksAndTabs) {
  EXPECT_EQ(words("  a  b\tc "), (Texts{"a", "b", "c"}));
  EXPECT_EQ(words(""), Texts{});
  EXPECT_EQ(words("12 3 734 inst/a.tsp  --as --alpha 2.92"),
            (Texts{"12", "3", "734", "inst/a.tsp", "--as", "--alpha", "2.92"}));
}

TEST(Words, KeepWhatIsQuoted) {
  EXPECT_EQ(words("'a b' \"c d\" e\\ f"), (Texts{"a b", "c d", "e f"}));
  EXPECT_EQ(words("a'b'\"c\"d"), (Texts{"abcd"}));
  EXPECT_EQ(words("'' \"\" x"), (Texts{"", "", "x"}));
  EXPECT_EQ(words(R"('a\b' "a\b" "a\"b" "\$1" "\\")"),
            (Texts{R"(a\b)", R"(a\b)", "a\"b", "$1", "\\"}));
  EXPECT_EQ(words("'$HOME *' a#b x~ a=1 --p=50%"),
            (Texts{"$HOME *", "a#b", "x~", "a=1", "--p=50%"}));
  EXPECT_EQ(words("a\\\nb"), (Texts{"ab"}));
}

TEST(Words, SayWhenOnlyAShellKnows) {
  for (const char* text : {"a;b", "a | b", "a&", "$HOME", "`x`", "a<b", "a>b", "(a)", "a)", "*.txt",
                           "a?", "[ab]", "{a,b}", "a\nb", "# x", "~/x", "\"$x\"", "\"`x`\""}) {
    EXPECT_TRUE(shell_for(text)) << text;
  }
  EXPECT_EQ(shell_for("a ~/x ; y"), '~');
  EXPECT_TRUE(split_words("a;b")->words.empty());
}

TEST(Words, NameWhatIsWrongAndWhere) {
  EXPECT_EQ(split_words("ab 'cd").error().where, "byte 4");
  EXPECT_EQ(split_words("a \"b").error().where, "byte 3");
  EXPECT_EQ(split_words("ab\\").error().where, "byte 3");
  EXPECT_EQ(split_words(std::string_view("a\0b", 3)).error().where, "byte 2");
}

TEST(Words, QuotedTextIsOneWordAgain) {
  for (const std::string text : {"", "a b", "it's", "'", "\\", "$x`y`", "a\nb", "\"", "''"}) {
    EXPECT_EQ(words(shell_quoted(text)), Texts{text});
  }
}

/// Random texts of what matters: whenever no shell is needed, a shell sees the same words.
TEST(Words, AreThoseOfARealShell) {
  constexpr std::string_view kAlphabet = "ab1 \t'\"\\-=#~!%^,.:/";
  Rng rng(7);
  const Interrupt never;
  std::string script;
  Texts expected;
  int compared = 0;
  while (compared < 300) {
    std::string text;
    const std::int64_t length = rng.uniform_int(0, 12);
    for (std::int64_t i = 0; i < length; ++i)
      text += kAlphabet[static_cast<std::size_t>(
          rng.uniform_int(0, static_cast<std::int64_t>(kAlphabet.size()) - 1))];
    const auto split = split_words(text);
    if (!split || split->needs_shell) continue;
    ++compared;
    script += "printf '[%s]' x " + text + "; echo\n";
    std::string line = "[x]";
    for (const std::string& word : split->words)
      line += "[" + word + "]";
    expected.push_back(line);
  }
  const auto end = value_of(run_process({.words = {"/bin/sh", "-c", script}}, never));
  std::string wanted;
  for (const std::string& line : expected)
    wanted += line + "\n";
  EXPECT_EQ(end.output.text, wanted);
}

}  // namespace
}  // namespace swarmsmith
