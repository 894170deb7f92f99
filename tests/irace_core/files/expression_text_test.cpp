#include "irace_core/files/expression_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/irace_core/files/random_expressions.h"
#include "tests/support/small_stack.h"

namespace swarmsmith {
namespace {

using ::swarmsmith::testing::RandomExpressions;

const std::vector<std::string> kNames = {"a", "b.c", "T", "1x", "_y", "if", "NumStates"};

struct Read {
  Expected<Expression> expression;
  std::vector<Error> warnings;
};
Read read(std::string_view text, ExpressionUse use = ExpressionUse::Value) {
  std::vector<Error> warnings;
  auto expression = parse_expression(text, kNames, use, {3, 10}, warnings);
  return {std::move(expression), std::move(warnings)};
}
std::string error_of(std::string_view text) {
  const Read result = read(text);
  return result.expression ? "none" : to_string(result.expression.error());
}
std::string reprinted(std::string_view text) {
  const Read result = read(text);
  return result.expression ? print(*result.expression) : to_string(result.expression.error());
}

TEST(ExpressionText, PrintsWithTheFewestParentheses) {
  EXPECT_EQ(reprinted("((a)+(b.c*2))"), "a + b.c * 2");
  EXPECT_EQ(reprinted("(a+b.c)*2"), "(a + b.c) * 2");
  EXPECT_EQ(reprinted("a-(b.c-2)"), "a - (b.c - 2)");
  EXPECT_EQ(reprinted("(a^2)^(b.c^3)"), "(a^2)^b.c^3");
  EXPECT_EQ(reprinted("(-2)^2 == -2^2"), "(-2)^2 == -2^2");
  EXPECT_EQ(reprinted("!(a==1)&!T"), "!(a == 1) & !T");
  EXPECT_EQ(reprinted("(a==1)==(b.c==2)"), "(a == 1) == (b.c == 2)");
  EXPECT_EQ(reprinted("1:(a+1)"), "1:(a + 1)");
  EXPECT_EQ(reprinted("c(1, 2.50, 1e5, 1e-7, 3L, 'x', NA)"),
            "c(1, 2.5, 100000, 1e-07, 3L, \"x\", NA)");
  EXPECT_EQ(reprinted("`1x` + `_y` + `if`"), "`1x` + `_y` + `if`");
  EXPECT_EQ(reprinted("round(a, digits = 2)"), "round(a, 2)");
}

// R's integers have no negative zero.
TEST(ExpressionText, KeepsEachSignOfAnIntegerZero) {
  EXPECT_EQ(reprinted("-0L"), "-0L");
  EXPECT_EQ(reprinted("a - ---0L"), "a - ---0L");
  EXPECT_EQ(*read("1 / -0L").expression->to_number({}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(*read("1 / (0L * -5L)").expression->to_number({}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(*read("1 / as.integer(-0.5)").expression->to_number({}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(*read("1 / -0").expression->to_number({}), -std::numeric_limits<double>::infinity());
}

TEST(ExpressionText, ReadsWhatOlderAutoMoDeFilesSay) {
  EXPECT_EQ(reprinted("as.numeric(NumStates)>0 "), "as.numeric(NumStates) > 0");
  EXPECT_EQ(reprinted("as.numeric(a) %in% c(0,1,2,5)"), "as.numeric(a) %in% c(0, 1, 2, 5)");
}

TEST(ExpressionText, NamesOfParametersGoBeforeTAndF) {
  EXPECT_EQ(read("T").expression->operation(), Operation::Parameter);
  EXPECT_EQ(*read("F").expression, Expression::logical(false));
}

TEST(ExpressionText, SaysWhatToWriteInstead) {
  EXPECT_EQ(error_of("a && b.c"), "3:12: found '&&': write '&', as irace needs it");
  EXPECT_EQ(error_of("a || b.c"), "3:12: found '||': write '|', as irace needs it");
  EXPECT_EQ(error_of("a == xyz"),
            "3:15: there is no parameter 'xyz' (a text needs quotes: \"xyz\")");
  EXPECT_EQ(error_of("numstates > 1"),
            "3:10: there is no parameter 'numstates' (did you mean \"NumStates\"?)");
  EXPECT_EQ(error_of("paste0(a)").substr(0, 61),
            "3:10: there is no function 'paste0' here; there are c as.nume");
  EXPECT_EQ(error_of("a %o% 1"), "3:12: there is no operator %o% here; there are %in%, %% and %/%");
  EXPECT_EQ(error_of("a == NULL"), "3:15: NULL has no meaning here");
  EXPECT_EQ(error_of("min(a, na.rm = TRUE)"),
            "3:25: the argument 'na.rm' of min() is not known here; give arguments by position");
  EXPECT_EQ(error_of("round(a, 1, 2)"), "3:10: round() takes 1 or 2 arguments, found 3");
  EXPECT_EQ(error_of("a %in% c()"), "3:17: c() takes 1 or more arguments, found 0");
  EXPECT_EQ(error_of("a ==").substr(0, 20), "3:14: found the end,");
}

TEST(ExpressionText, RangesAreSearchedWithoutListingThem) {
  const auto value = [](std::string_view text) {
    auto expression = read(text).expression;
    EXPECT_TRUE(expression && expression->bind(kNames)) << text;
    const std::vector<Scalar> values(kNames.size(), Scalar::integer(7));
    return to_text(expression->evaluate(values)[0]);
  };
  EXPECT_EQ(value("a %in% 1:1e9"), "TRUE");
  EXPECT_EQ(value("a %in% 9:-1e9"), "TRUE");
  EXPECT_EQ(value("a %in% 8:1e9"), "FALSE");
  EXPECT_EQ(value("a + 0.5 %in% 1:10"), "7");
  EXPECT_EQ(value("(a + 0.5) %in% 1:10"), "FALSE");
  EXPECT_EQ(value("(a + 0.5) %in% 1.5:10"), "TRUE");
  EXPECT_EQ(value("as.character(a) %in% 1:20"), "TRUE");
  EXPECT_EQ(value("'7.0' %in% 1:20"), "FALSE") << "compared as texts";
  EXPECT_EQ(value("NA %in% 1:20"), "FALSE");
  EXPECT_EQ(value("c(3, a) %in% 1:6"), "TRUE");
  EXPECT_EQ(value("a %in% c(1:6, 7)"), "TRUE");
  EXPECT_EQ(value("c('7', 'x') %in% c(5, a, 9)"), "TRUE");
  EXPECT_EQ(error_of("a %in% c(0, 1:20000)"),
            "3:23: a range of 10000 numbers or more is allowed only after %in%");
}

TEST(ExpressionText, ForbiddenLinesMayHaveDoubledOperators) {
  const Read result = read("a == 1 && b.c == 2 || T", ExpressionUse::Forbidden);
  ASSERT_TRUE(result.expression);
  EXPECT_EQ(print(*result.expression), "a == 1 & b.c == 2 | T");
  ASSERT_EQ(result.warnings.size(), 2U);
  EXPECT_EQ(to_string(result.warnings[0]), "3:29: '||' is read as '|'");
  EXPECT_EQ(to_string(result.warnings[1]), "3:17: '&&' is read as '&'");
}

TEST(ExpressionText, WhatIsPrintedReadsBackAsTheSame) {
  Rng rng(20261121);
  RandomExpressions random(rng, kNames);
  for (int i = 0; i < 20000; ++i) {
    const Expression expression = random.any(1 + i % 6);
    const std::string text = print(expression);
    const Read again = read(text);
    ASSERT_TRUE(again.expression) << text << ": " << to_string(again.expression.error());
    ASSERT_EQ(*again.expression, expression) << text << "\n" << print(*again.expression);
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(ExpressionText, DeepTreesReadBackOrAreRefused) {
  for (const std::string text : {"!", "-", "2^-", "(1 < ", "!(T & ", "1 - (", "c(2, "}) {
    for (const int depth : {20, 90, 120}) {
      std::string all;
      for (int i = 0; i < depth; ++i)
        all += text;
      all += "a";
      for (int i = 0; i < depth && text.find('(') != std::string::npos; ++i)
        all += ')';
      const Read result = read(all);
      if (depth == 120) {
        EXPECT_EQ(error_of(all).find("nested too deeply") == std::string::npos, false) << text;
      } else if (result.expression) {
        const Read again = read(print(*result.expression));
        ASSERT_TRUE(again.expression) << text << to_string(again.expression.error());
        EXPECT_EQ(*again.expression, *result.expression);
      } else {
        EXPECT_EQ(depth, 90) << text;
      }
    }
  }
}

TEST(ExpressionText, NeedsLittleStackHoweverLongATextIs) {
  with_small_stack([] {
    for (const std::string part :
         {"!", "-", "2^", "1 + ", "a & ", "(", "!(", "c(", "a %in% c(1, "}) {
      for (const int times : {900, 200'000}) {
        std::string text;
        for (int i = 0; i < times; ++i)
          text += part;
        text += "1";
        for (int i = 0; i < times && part.find('(') != std::string::npos; ++i)
          text += ')';
        const Read result = read(text);
        EXPECT_TRUE(times == 900 || !result.expression) << part;
        if (!result.expression) continue;
        EXPECT_TRUE(read(print(*result.expression)).expression) << part;
      }
    }
  });
}

TEST(ExpressionText, MinusBeforeAConstantReadsBackAsANegativeConstant) {
  const Expression minus = Expression::call(Operation::Negate, {Expression::number(3)});
  EXPECT_EQ(print(minus), "-3");
  EXPECT_EQ(*read("-3").expression, Expression::number(-3));
}

}  // namespace
}  // namespace swarmsmith
