#include "irace_core/files/r_syntax.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/overloaded.h"

namespace swarmsmith::r {
namespace {

std::string show(const Node& node);

std::string show(const Call& call) {
  std::string text = call.function + "(";
  for (const Argument& argument : call.arguments) {
    if (text.back() != '(') text += ' ';
    text += argument.name.empty() ? "" : argument.name + "=";
    text += show(argument.value);
  }
  return text + ")";
}

/// A tree as calls: "+(1 *(2 3))".
std::string show(const Node& node) {
  return std::visit(Overloaded{
                        [](const Number& number) {
                          std::string text = std::to_string(number.value);
                          text.erase(text.find_last_not_of('0') + 1);
                          if (text.back() == '.') text.pop_back();
                          return text + (number.is_integer ? "L" : "");
                        },
                        [](const Text& text) { return "\"" + text.value + "\""; },
                        [](const Name& name) { return name.value; },
                        [](const Logical& logical) -> std::string {
                          return !logical.value ? "NA" : *logical.value ? "TRUE" : "FALSE";
                        },
                        [](const Null&) -> std::string { return "NULL"; },
                        [](const Call& call) { return show(call); },
                    },
                    node.what);
}

std::string shown(std::string_view text) {
  const auto node = parse_expression(text);
  return node ? show(*node) : "error " + swarmsmith::to_string(node.error());
}

std::string error_of(std::string_view text) {
  const auto node = parse_expression(text);
  return node ? "none" : swarmsmith::to_string(node.error());
}

TEST(RSyntax, BindsOperatorsAsRDoes) {
  EXPECT_EQ(shown("a | b & !c == d + e * f %in% g:-h^i"),
            "|(a &(b !(==(c +(d *(e %in%(f :(g -(^(h i))))))))))");
  EXPECT_EQ(shown("-2^2"), "-(^(2 2))");
  EXPECT_EQ(shown("2^-1^2"), "^(2 -(^(1 2)))");
  EXPECT_EQ(shown("2^3^4"), "^(2 ^(3 4))");
  EXPECT_EQ(shown("-1:3"), ":(-(1) 3)");
  EXPECT_EQ(shown("2^-1:3"), ":(^(2 -(1)) 3)");
  EXPECT_EQ(shown("8 - 4 - 2"), "-(-(8 4) 2)");
  EXPECT_EQ(shown("8 / 4 * 2"), "*(/(8 4) 2)");
  EXPECT_EQ(shown("7 %% 4 %/% 2"), "%/%(%%(7 4) 2)");
  EXPECT_EQ(shown("-a %in% b"), "%in%(-(a) b)");
  EXPECT_EQ(shown("!a & b"), "&(!(a) b)");
  EXPECT_EQ(shown("!a == b"), "!(==(a b))");
  EXPECT_EQ(shown("a + !b == c & d"), "&(+(a !(==(b c))) d)");
  EXPECT_EQ(shown("a == !b & c"), "&(==(a !(b)) c)");
  EXPECT_EQ(shown("a && b || c"), "||(&&(a b) c)");
  EXPECT_EQ(shown("(a | b) & c"), "&(|(a b) c)");
  EXPECT_EQ(shown("!!a"), "!(!(a))");
  EXPECT_EQ(shown("- - +a"), "-(-(+(a)))");
}

TEST(RSyntax, ReadsNumbers) {
  EXPECT_EQ(shown("c(1, 2L, .5, 5., 1e3, 1E-2, 0x1F, 0xfL, 1e3L, 1.5L)"),
            "c(1 2L 0.5 5 1000 0.01 31 15L 1000L 1.5)");
  EXPECT_EQ(std::get<Number>(parse_expression("1e999")->what).value, HUGE_VAL);
  EXPECT_EQ(std::get<Number>(parse_expression("1e-999")->what).value, 0);
  EXPECT_FALSE(std::get<Number>(parse_expression("3000000000L")->what).is_integer);
  EXPECT_EQ(std::get<Number>(parse_expression("Inf")->what).value, HUGE_VAL);
  EXPECT_EQ(error_of("10abc"), "1:3: found 'abc', expected an operator or the end");
  EXPECT_EQ(error_of("1e"), "1:2: found 'e', expected an operator or the end");
}

TEST(RSyntax, ReadsStrings) {
  EXPECT_EQ(shown(R"("a 'b' \"c\"")"), "\"a 'b' \"c\"\"");
  EXPECT_EQ(shown(R"('a "b" \'c\'')"), "\"a \"b\" 'c'\"");
  EXPECT_EQ(shown(R"("tab\tline\nback\\slash")"), "\"tab\tline\nback\\slash\"");
  EXPECT_EQ(shown(R"("\x41\102\u00e9\u{e9}\U1F600")"), "\"AB\u00e9\u00e9\U0001F600\"");
  EXPECT_EQ(shown("\"a # b\" # comment"), "\"a # b\"");
  EXPECT_EQ(shown("'gr\u00fcn'"), "\"gr\u00fcn\"");
  EXPECT_EQ(error_of("x == \"abc"), "1:6: this string is not closed: expected \"");
  EXPECT_EQ(error_of("x == \"C:\\dir\""),
            "1:9: found the unknown escape \\d in a string; for a backslash write \\\\, in a path "
            "write /");
  EXPECT_EQ(error_of("\"\\x\"").substr(0, 21), "1:2: the escape \\x ne");
}

TEST(RSyntax, ReadsNamesAndConstants) {
  EXPECT_EQ(shown("c(TRUE, FALSE, NA, NULL, T, F, .a.b_1, `x y`, `if`)"),
            "c(TRUE FALSE NA NULL T F .a.b_1 x y if)");
  EXPECT_EQ(shown("paste0(\"a\", sep = 'b', \"c d\"=1)"), "paste0(\"a\" sep=\"b\" c d=1)");
  EXPECT_EQ(shown("c()"), "c()");
  EXPECT_EQ(logical_of(*parse_expression("T")), true);
  EXPECT_EQ(logical_of(*parse_expression("FALSE")), false);
  EXPECT_EQ(logical_of(*parse_expression("NA")), std::nullopt);
  EXPECT_EQ(logical_of(*parse_expression("x")), std::nullopt);
}

TEST(RSyntax, SaysWhatItFoundAndWhatItExpected) {
  EXPECT_EQ(error_of(""), "1:1: found the end, expected a value, a name or '('");
  EXPECT_EQ(error_of("a =="), "1:5: found the end, expected a value, a name or '('");
  EXPECT_EQ(error_of("a = 1"), "1:3: found '=', expected an operator; to compare write ==");
  EXPECT_EQ(error_of("(a + b"), "1:7: found the end, expected ')' for the '(' at 1:1");
  EXPECT_EQ(error_of("c(1, 2"), "1:7: found the end, expected ',' or ')' for the '(' at 1:2");
  EXPECT_EQ(error_of("c(1,)"), "1:5: found ')', expected another argument after ','");
  EXPECT_EQ(error_of("a)"), "1:2: found ')', expected an operator or the end");
  EXPECT_EQ(error_of("a b"), "1:3: found 'b', expected an operator or the end");
  EXPECT_EQ(error_of("a %in c(1)"), "1:3: expected a second % on this line, as in %in%");
  EXPECT_EQ(error_of("a < b < c"),
            "1:7: found a second comparison; write a < b & b < c for a < b < c");
  EXPECT_EQ(error_of("x[1]"), "1:2: found '[', expected an operator or the end");
  EXPECT_EQ(error_of("function(x) x").substr(0, 34), "1:1: found 'function': programs in");
  EXPECT_EQ(error_of("a == \u201cx\u201d"),
            "1:6: found the typographic character '\u201c'; write a plain blank, dash or quote");
  EXPECT_EQ(error_of("\"\u00e9\u00e9\" ?").substr(0, 5), "1:6: ") << "columns count characters";
  EXPECT_EQ(swarmsmith::to_string(parse_expression("a b", {7, 20}).error()).substr(0, 6), "7:22: ");
}

TEST(RSyntax, BoundsTheDepthOfTrees) {
  const auto repeated = [](const std::string& text, int n) {
    std::string all;
    for (int i = 0; i < n; ++i)
      all += text;
    return all;
  };
  EXPECT_TRUE(parse_expression(repeated("(", 150) + "a" + repeated(")", 150)));
  EXPECT_TRUE(parse_expression(repeated("a + ", 990) + "a"));
  for (const std::string text : {"(", "!", "-", "f(", "a^", "c(a="}) {
    EXPECT_NE(error_of(repeated(text, 100000)).find("nested too deeply"), std::string::npos)
        << text;
  }
  EXPECT_NE(error_of(repeated("a + ", 100000) + "a").find("too long"), std::string::npos);
}

TEST(RSyntax, ReadsStatements) {
  const auto statements = parse_statements(
      "\xef\xbb\xbf# a comment\r\n"
      "maxExperiments = 1e4 ; digits <- 4L\r\n"
      "\n"
      "\"x\" = c(1,\n  2) # goes on within parentheses\n"
      "y <- 1 +\n 2\n"
      "include.scenario('other.txt')\n"
      "z =\n NULL");
  ASSERT_TRUE(statements) << swarmsmith::to_string(statements.error());
  std::string all;
  for (const Statement& statement : *statements) {
    all += to_string(statement.place) + " " + statement.name + " = " + show(statement.value) + "\n";
  }
  EXPECT_EQ(all,
            "2:1 maxExperiments = 10000\n"
            "2:24 digits = 4L\n"
            "4:1 x = c(1 2)\n"
            "6:1 y = +(1 2)\n"
            "8:1  = include.scenario(\"other.txt\")\n"
            "9:1 z = NULL\n");
}

TEST(RSyntax, SaysWhereAStatementIsWrong) {
  const auto error = [](std::string_view text) {
    const auto statements = parse_statements(text);
    return statements ? "none" : swarmsmith::to_string(statements.error());
  };
  EXPECT_EQ(error("a = 1\nb = 2 c = 3"),
            "2:7: found 'c', expected an operator or the end of the line");
  EXPECT_EQ(error("a = \n\n"), "3:1: found the end, expected a value, a name or '('");
  EXPECT_EQ(error("1 = 2"), "1:3: found '=', expected a name before it");
  EXPECT_EQ(error("a = 'x\ny = 3"), "1:5: this string is not closed: expected '");
  EXPECT_EQ(error("f <- function(x) { x }").substr(0, 22), "1:6: found 'function':");
}

}  // namespace
}  // namespace swarmsmith::r
