#include "base/text/document.h"

#include <gtest/gtest.h>

#include "tests/support/small_stack.h"

namespace swarmsmith {
namespace {

std::string repeated(std::string_view part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i)
    text += part;
  return text;
}

/// The error's text; empty when it was read.
std::string refusal(const std::string& text) {
  const auto read = parse_document(text, "f.toml");
  return read ? "" : to_string(read.error());
}

TEST(Documents, ThatAreNestedWithoutEndAreRefusedWithTheirPlace) {
  constexpr int kMany = 200'000;
  const std::string deep[] = {
      "[a" + repeated(".a", kMany) + "]\n",
      "[[a" + repeated(".a", kMany) + "]]\n",
      "[a" + repeated(" . a", kMany) + "]\n",
      "a" + repeated(".a", kMany) + " = 1\n",
      "\"a\"" + repeated(".\"a\"", kMany) + " = 1\n",
      "'.'" + repeated(".'='", kMany) + " = 1\n",
      "a = " + repeated("[", kMany),
      "a = " + repeated("[", kMany) + repeated("]", kMany) + "\n",
      "a = " + repeated("[\n", kMany) + repeated("]", kMany) + "\n",
      "a = " + repeated("{a = ", kMany) + "1" + repeated("}", kMany) + "\n",
      "a = " + repeated("[{a = ", kMany) + "1" + repeated("}]", kMany) + "\n",
      "a = {a" + repeated(".a", kMany) + " = 1}\n",
      // No part is deep, all together are.
      "[a" + repeated(".a", 40) + "]\nb" + repeated(".b", 40) + " = 1\n",
      "[a" + repeated(".a", 40) + "]\nb" + repeated(".b", 20) + " = {c = [{d.e.f = 1}]}\n",
      "a = " + repeated("{a.a.a.a.a.a.a.a.a = ", 60) + "1" + repeated("}", 60) + "\n",
  };
  with_small_stack([&] {
    for (const std::string& text : deep) {
      const std::string said = refusal(text);
      EXPECT_NE(said.find("deeper than 64 levels"), std::string::npos)
          << text.substr(0, 40) << ": " << said;
      EXPECT_EQ(said.find("f.toml:"), 0U) << said;
    }
  });
  EXPECT_EQ(refusal("x = 1\n\na = [" + repeated("[", 100)).substr(0, 12), "f.toml:3:68:");
}

TEST(Documents, MayBeDeepAndLong) {
  with_small_stack([] {
    EXPECT_EQ(refusal("[a" + repeated(".a", 61) + "]\nb.c = 1\n"), "");
    EXPECT_EQ(refusal("a = " + repeated("{a = ", 60) + "[1.5, 2.5]" + repeated("}", 60) + "\n"),
              "");
    EXPECT_EQ(refusal(repeated("[[a.b]]\nc.d = [1.5, [2.5, {e = 3.5}]]\n", 10'000)), "");
    EXPECT_EQ(refusal("a = [\n" + repeated("  [1.5, 2.5],\n", 10'000) + "]\n"), "");
  });
  // Dots and brackets in strings and comments are letters.
  const std::string dots = repeated(".[{", 1000);
  EXPECT_EQ(refusal("a = \"" + dots + "\" # " + dots + "\nb = '" + dots + "'\nc = \"\"\"\n" + dots +
                    "\n\"\"\"\nd = '''" + dots + "\n'''\n\"" + dots + "\" = 1\n"),
            "");
}

}  // namespace
}  // namespace swarmsmith
