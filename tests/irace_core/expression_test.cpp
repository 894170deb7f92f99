#include "irace_core/expression.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;
using enum Operation;

/// The value of an expression without parameters.
Scalar value(const Expression& expression) {
  return expression.evaluate({})[0];
}

/// All elements with their types: "integer 3, integer 4".
std::string shown(const Expression& expression) {
  constexpr const char* kTypes[] = {"logical ", "integer ", "real ", "text "};
  std::string all;
  const Values values = expression.evaluate({});
  for (std::size_t i = 0; i < values.size(); ++i) {
    all += (i == 0 ? "" : ", ") + std::string(kTypes[static_cast<int>(values[i].type)]) +
           to_text(values[i]);
  }
  return all;
}

Expression integer(std::int32_t value) {
  return Expression::integer(value);
}
Expression yes() {
  return Expression::logical(true);
}
Expression no() {
  return Expression::logical(false);
}
Expression list(std::vector<Expression> elements) {
  return Expression::call(Combine, std::move(elements));
}
/// Infinite, of either sign.
Expression infinite(double sign) {
  return call(Divide, number(sign), number(0));
}

struct Calculated {
  Expression expression;
  const char* value;
};

void expect_values(const std::vector<Calculated>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(shown(cases[i].expression), cases[i].value) << "case " << i;
}

TEST(Expression, CalculatesPowersAsRDoes) {
  expect_values({
      {call(Power, number(2), negate_of(2)), "real 0.25"},
      {call(Power, integer(3), integer(5)), "real 243"},
      {call(Round, call(Power, number(2), number(0.5)), number(9)), "real 1.414213562"},
      {call(Round, call(Power, number(0.25), number(0.5)), number(9)), "real 0.5"},
      {call(Power, number(0), number(0.5)), "real 0"},
      {call(Power, number(0), negate_of(0.5)), "real Inf"},
      {call(Power, number(0), number(0)), "real 1"},
      {call(Power, negate_of(8), number(3)), "real -512"},
      {call(Power, negate_of(8), number(0.5)), "real NA"},
      {call(Power, number(1), Expression::missing()), "real NA"},
      {call(Power, number(1), infinite(1)), "real 1"},
      {call(Power, number(2), infinite(1)), "real Inf"},
      {call(Power, negate_of(1), number(1'000'000)), "real 1"},
  });
}

TEST(Expression, DividesWholeNumbersAsRDoes) {
  expect_values({
      {call(Modulo, number(5.5), number(2)), "real 1.5"},
      {call(Modulo, number(5.5), number(1)), "real 0.5"},
      {call(Modulo, integer(-7), integer(3)), "integer 2"},
      {call(Modulo, integer(7), integer(-3)), "integer -2"},
      {call(Modulo, integer(5), integer(0)), "integer NA"},
      {call(Modulo, number(5), number(0)), "real NA"},
      {call(Modulo, infinite(1), number(2)), "real NA"},
      {call(Modulo, number(5), infinite(1)), "real 5"},
      {call(Modulo, negate_of(5), infinite(1)), "real Inf"},
      {call(Modulo, negate_of(5), infinite(-1)), "real -5"},
      {call(Modulo, number(5), infinite(-1)), "real -Inf"},
      {call(Modulo, number(0), infinite(-1)), "real 0"},
      {call(IntegerDivide, number(7.5), number(2)), "real 3"},
      {call(IntegerDivide, integer(-7), integer(2)), "integer -4"},
      {call(IntegerDivide, integer(7), integer(0)), "integer NA"},
      {call(IntegerDivide, number(7), number(0)), "real Inf"},
      {call(IntegerDivide, number(7), infinite(1)), "real 0"},
      {call(IntegerDivide, negate_of(7), infinite(1)), "real -1"},
      {call(IntegerDivide, negate_of(7), infinite(-1)), "real 0"},
      {call(IntegerDivide, number(0), infinite(-1)), "real 0"},
      {call(IntegerDivide, infinite(1), infinite(1)), "real NA"},
      {call(Divide, integer(7), integer(2)), "real 3.5"},
      {call(Divide, integer(0), integer(0)), "real NA"},
  });
}

/// Whole numbers and logicals stay whole; a text is no number.
TEST(Expression, GivesResultsTheTypeThatRGivesThem) {
  expect_values({
      {call(Add, integer(1), integer(2)), "integer 3"},
      {call(Add, integer(1), number(2)), "real 3"},
      {call(Add, number(1), integer(2)), "real 3"},
      {call(Subtract, yes(), integer(3)), "integer -2"},
      {call(Multiply, yes(), yes()), "integer 1"},
      {call(Add, text("1"), number(1)), "real NA"},
      {call(Add, number(1), text("1")), "real NA"},
      {call(Add, integer(1), Expression::missing()), "real NA"},
      {call(Negate, integer(3)), "integer -3"},
      {call(Negate, number(3)), "real -3"},
      {call(Negate, text("3")), "real NA"},
      {call(Abs, integer(-3)), "integer 3"},
      {call(Abs, number(-3.5)), "real 3.5"},
      {call(Abs, Expression::missing()), "real NA"},
      {call(Floor, number(-2.5)), "real -3"},
      {call(Ceiling, number(-2.5)), "real -2"},
      {call(Truncate, number(-2.5)), "real -2"},
      {call(SquareRoot, integer(9)), "real 3"},
      {call(SquareRoot, negate_of(9)), "real NA"},
      {call(Exp, number(0)), "real 1"},
      {call(Log, number(8), number(2)), "real 3"},
      {call(Log, number(1)), "real 0"},
      {call(Log, text("8"), number(2)), "real NA"},
      {call(Round, number(2.345), number(1)), "real 2.3"},
      {call(Round, number(2.5)), "real 2"},
      {call(Round, number(0.1234), number(20)), "real 0.1234"},
      {call(Round, number(2.345), Expression::missing()), "real NA"},
      {call(Round, number(1.25), number(0.5)), "real 1.2"},
      {call(Round, number(1.25), number(0.4)), "real 1"},
      {call(Round, number(1234), negate_of(2)), "real 1200"},
      {call(Round, number(150), negate_of(2)), "real 200"},
      {call(Round, number(250), negate_of(2)), "real 200"},
      {call(Round, negate_of(1250), negate_of(2)), "real -1200"},
      {call(Round, number(5), negate_of(1)), "real 0"},
      {call(Round, number(7), negate_of(400)), "real 0"},
      {call(Round, text("2")), "real NA"},
  });
}

TEST(Expression, ConvertsAsRDoes) {
  expect_values({
      {call(AsNumeric, text(" 1e3 ")), "real 1000"},
      {call(AsNumeric, text("+2")), "real 2"},
      {call(AsNumeric, text("1x")), "real NA"},
      {call(AsNumeric, text(" ")), "real NA"},
      {call(AsNumeric, text("")), "real NA"},
      {call(AsNumeric, yes()), "real 1"},
      {call(AsNumeric, Expression::missing()), "real NA"},
      {call(AsInteger, number(-2.7)), "integer -2"},
      {call(AsInteger, text("2.7")), "integer 2"},
      {call(AsInteger, text("two")), "integer NA"},
      {call(AsText, number(0.5)), "text 0.5"},
      {call(AsText, no()), "text FALSE"},
      {call(AsText, Expression::missing()), "text NA"},
      {call(IsMissing, Expression::missing()), "logical TRUE"},
      {call(IsMissing, number(0)), "logical FALSE"},
      {list({yes(), integer(2)}), "integer 1, integer 2"},
      {list({integer(2), number(0.5), no()}), "real 2, real 0.5, real 0"},
      {list({number(1), text("a"), yes()}), "text 1, text a, text TRUE"},
      {list({Expression::missing(), number(1)}), "real NA, real 1"},
  });
}

/// Any number but 0 is true; a text has no truth.
TEST(Expression, TakesNumbersForTruthAndTextsForNone) {
  expect_values({
      {call(And, number(2), integer(-1)), "logical TRUE"},
      {call(And, number(0), Expression::missing()), "logical FALSE"},
      {call(And, text("x"), yes()), "logical NA"},
      {call(And, text("x"), no()), "logical FALSE"},
      {call(And, yes(), no()), "logical FALSE"},
      {call(Or, number(0), number(0)), "logical FALSE"},
      {call(Or, Expression::missing(), number(3)), "logical TRUE"},
      {call(Or, text("x"), no()), "logical NA"},
      {call(Xor, number(2), number(3)), "logical FALSE"},
      {call(Xor, yes(), number(0)), "logical TRUE"},
      {call(Xor, yes(), Expression::missing()), "logical NA"},
      {call(Not, number(0)), "logical TRUE"},
      {call(Not, number(2)), "logical FALSE"},
      {call(Not, text("x")), "logical NA"},
  });
}

/// A number beside a text is compared as text.
TEST(Expression, ComparesNumbersAndTexts) {
  struct Sides {
    Expression a;
    Expression b;
    int sign;  ///< of a - b
  };
  const std::vector<Sides> sides = {
      {number(1), integer(2), -1}, {number(2), number(2), 0},   {number(3), number(2), 1},
      {text("a"), text("B"), -1},  {text("b"), text("b"), 0},   {text("b"), text("A"), 1},
      {number(10), text("9"), -1}, {text("10"), number(9), -1}, {text("2"), number(2), 0},
      {integer(9), text("10"), 1}, {text("TRUE"), yes(), 0},
  };
  for (const auto& [a, b, sign] : sides) {
    const auto holds = [&a = a, &b = b](Operation operation) {
      return value(call(operation, a, b)) == Scalar::logical(true);
    };
    EXPECT_EQ(holds(Equal), sign == 0) << shown(a) << " and " << shown(b);
    EXPECT_EQ(holds(NotEqual), sign != 0) << shown(a) << " and " << shown(b);
    EXPECT_EQ(holds(Less), sign < 0) << shown(a) << " and " << shown(b);
    EXPECT_EQ(holds(LessEqual), sign <= 0) << shown(a) << " and " << shown(b);
    EXPECT_EQ(holds(Greater), sign > 0) << shown(a) << " and " << shown(b);
    EXPECT_EQ(holds(GreaterEqual), sign >= 0) << shown(a) << " and " << shown(b);
  }
  expect_values({
      {call(Less, Expression::missing(), number(1)), "logical NA"},
      {call(GreaterEqual, number(1), Expression::missing()), "logical NA"},
  });
}

TEST(Expression, FindsTheLeastAndTheLargestOfAllElements) {
  expect_values({
      {call(Max, number(1.5), number(2.5)), "real 2.5"},
      {call(Min, list({integer(3), integer(1)}), integer(2)), "integer 1"},
      {call(Max, list({integer(3), integer(1)}), integer(2)), "integer 3"},
      {call(Min, yes(), yes()), "integer 1"},
      {call(Max, text("b"), text("A")), "text b"},
      {call(Min, text("b"), integer(10)), "text 10"},
      {call(Min, integer(1), Expression::missing()), "integer NA"},
      {call(Max, Expression::missing(), number(1)), "real NA"},
  });
}

TEST(Expression, CountsFromOneNumberToAnother) {
  expect_values({
      {call(Range, integer(1), integer(3)), "integer 1, integer 2, integer 3"},
      {call(Range, number(3), number(1)), "integer 3, integer 2, integer 1"},
      {call(Range, number(2), number(2)), "integer 2"},
      {call(Range, number(0.5), number(2.6)), "real 0.5, real 1.5, real 2.5"},
      {call(Range, number(2.5), number(1)), "real 2.5, real 1.5"},
      {call(Range, text("1"), text("2")), "integer 1, integer 2"},
      {call(Range, text("a"), number(2)), "integer NA"},
      {call(Range, number(1), Expression::missing()), "integer NA"},
      {call(Range, number(1), infinite(1)), "integer NA"},
      {call(Range, number(2147483647), number(2147483647)), "integer 2147483647"},
      {call(Range, number(2147483647), number(2147483648)), "real 2147483647, real 2147483648"},
      {call(Range, list({integer(2), integer(9)}), list({integer(3), integer(9)})),
       "integer 2, integer 3"},
      {call(Range, number(0), number(10'000)), "integer NA"},
  });
  EXPECT_EQ(call(Range, number(1), number(10'000)).evaluate({}).size(), 10'000U);
}

/// Without and with a list of the numbers; the operand is one value or several.
TEST(Expression, FindsElementsInSetsAndRanges) {
  const auto to = [](double last) { return call(Range, number(2), number(last)); };
  expect_values({
      {call(In, integer(2), to(4)), "logical TRUE"},
      {call(In, integer(4), to(4)), "logical TRUE"},
      {call(In, integer(5), to(4)), "logical FALSE"},
      {call(In, integer(1), to(4)), "logical FALSE"},
      {call(In, number(2.5), to(4)), "logical FALSE"},
      {call(In, integer(1), to(0)), "logical TRUE"},
      {call(In, integer(3), to(0)), "logical FALSE"},
      {call(In, text("3"), to(4)), "logical TRUE"},
      {call(In, text("x"), to(4)), "logical FALSE"},
      {call(In, Expression::missing(), to(4)), "logical FALSE"},
      {call(In, integer(3), call(Range, number(1), Expression::missing())), "logical FALSE"},
      {call(In, integer(20'000), to(30'000)), "logical TRUE"},
      {call(In, list({integer(1), integer(2)}), to(4)), "logical FALSE, logical TRUE"},
      {call(In, Expression::missing(), list({integer(0), integer(1)})), "logical FALSE"},
      {call(In, no(), Expression::missing()), "logical FALSE"},
      {call(In, Expression::missing(), Expression::missing()), "logical TRUE"},
      {call(In, integer(3), list({integer(1), integer(3)})), "logical TRUE"},
      {call(In, text("3"), list({integer(1), integer(3)})), "logical TRUE"},
      {call(In, integer(2), list({integer(1), integer(3)})), "logical FALSE"},
      {call(In, integer(2), call(Add, integer(1), integer(1))), "logical TRUE"},
      {call(In, call(Add, integer(1), integer(1)), integer(3)), "logical FALSE"},
      {call(In, list({integer(5), integer(1), integer(2)}),
            call(Add, list({integer(3), integer(1)}), integer(0))),
       "logical FALSE, logical TRUE, logical FALSE"},
      {call(In, list({text("b"), Expression::missing(), text("3")}),
            list({integer(3), Expression::missing(), text("a")})),
       "logical FALSE, logical TRUE, logical TRUE"},
      {call(In, list({integer(10), integer(9)}), list({text("9"), text("1")})),
       "logical FALSE, logical TRUE"},
  });
}

TEST(Expression, ChoosesElementByElement) {
  expect_values({
      {call(IfElse, list({yes(), Expression::missing(), no(), number(2)}), number(1), number(2)),
       "real 1, logical NA, real 2, real 1"},
      {call(IfElse, list({yes(), no(), no()}), integer(1), list({integer(5), integer(6)})),
       "integer 1, integer 6, integer 5"},
      {call(IfElse, list({no(), yes(), yes()}), list({integer(5), integer(6)}), integer(1)),
       "integer 1, integer 6, integer 5"},
      {call(Add, call(Range, number(1), number(4)), call(Range, number(0), number(1))),
       "integer 1, integer 3, integer 3, integer 5"},
      {call(Negate, call(Range, number(1), number(2))), "integer -1, integer -2"},
  });
}

TEST(Expression, PropagatesMissingThroughComparisons) {
  EXPECT_TRUE(value(call(Less, Expression::missing(), number(1))).missing);
  EXPECT_FALSE(call(Less, Expression::missing(), number(1)).is_true({}));
}

TEST(Expression, KnowsLogicWithMissingValues) {
  const Expression unknown = Expression::missing();
  const Expression yes = Expression::logical(true);
  const Expression no = Expression::logical(false);
  EXPECT_TRUE(value(call(And, unknown, yes)).missing);
  EXPECT_EQ(value(call(And, unknown, no)), Scalar::logical(false));
  EXPECT_EQ(value(call(Or, yes, unknown)), Scalar::logical(true));
  EXPECT_TRUE(value(call(Or, unknown, no)).missing);
  EXPECT_TRUE(value(call(Not, unknown)).missing);
  EXPECT_TRUE(value(call(Xor, unknown, yes)).missing);
}

TEST(Expression, FindsMissingValuesInASet) {
  const Expression unknown = Expression::missing();
  EXPECT_EQ(value(Expression::in(unknown, {number(1)})), Scalar::logical(false));
  EXPECT_EQ(value(Expression::in(unknown, {number(1), unknown})), Scalar::logical(true));
}

TEST(Expression, TakesOnlyASingleTrueForTrue) {
  EXPECT_FALSE(number(1).is_true({}));
  EXPECT_FALSE(Expression::call(Combine, {Expression::logical(true), Expression::logical(true)})
                   .is_true({}));
}

TEST(Expression, OrdersTextsWithoutRegardToCaseFirst) {
  EXPECT_LT(compare_texts("apple", "Banana"), 0);
  EXPECT_LT(compare_texts("10", "2"), 0);
  EXPECT_LT(compare_texts("a", "A"), 0);
  EXPECT_LT(compare_texts("A", "ab"), 0);
  EXPECT_LT(compare_texts("_", "1"), 0);
  EXPECT_EQ(compare_texts("same", "same"), 0);
}

/// The order of all signs, each before the next: punctuation, digits, letters, other signs.
TEST(Expression, OrdersEachSignBeforeTheNext) {
  const std::vector<std::string> order = {"",  " ", "!", "/", ":",    "@",   "[", "`",
                                          "{", "~", "0", "9", "a",    "A",   "b", "B",
                                          "y", "Y", "z", "Z", "\x80", "\xff"};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < order.size(); ++j) {
      const int sign = compare_texts("x" + order[i], "x" + order[j]);
      EXPECT_EQ(sign < 0, i < j) << order[i] << " and " << order[j];
      EXPECT_EQ(sign == 0, i == j) << order[i] << " and " << order[j];
    }
  }
  // The first difference in the case of letters decides where nothing else differs.
  EXPECT_LT(compare_texts("aA", "Aa"), 0);
  EXPECT_GT(compare_texts("Aa", "aA"), 0);
  EXPECT_LT(compare_texts("abC", "aBc"), 0);
}

TEST(Expression, WritesNumbersInTheShorterNotation) {
  EXPECT_EQ(to_text(Scalar::real(100000)), "1e+05");
  EXPECT_EQ(to_text(Scalar::real(123456)), "123456");
  EXPECT_EQ(to_text(Scalar::real(0.0001)), "1e-04");
  EXPECT_EQ(to_text(Scalar::real(0.1 + 0.2)), "0.3");
  EXPECT_EQ(to_text(Scalar::real(-1.5e-7)), "-1.5e-07");
  EXPECT_EQ(to_text(Scalar::real(-2e300)), "-2e+300");
  EXPECT_EQ(to_text(Scalar::real(1e-100)), "1e-100");
  EXPECT_EQ(to_text(Scalar::real(1e15)), "1e+15");
  EXPECT_EQ(to_text(Scalar::real(123456789012345680.0)), "123456789012345680");
  EXPECT_EQ(to_text(Scalar::real(1.0 / 3)), "0.333333333333333");
  EXPECT_EQ(to_text(Scalar::real(-0.0)), "0");
  EXPECT_EQ(to_text(Scalar::real(HUGE_VAL)), "Inf");
  EXPECT_EQ(to_text(Scalar::real(-HUGE_VAL)), "-Inf");
  EXPECT_EQ(to_text(Scalar::logical(false)), "FALSE");
  EXPECT_EQ(to_fixed_text(1e-5), "0.00001");
  EXPECT_EQ(to_fixed_text(-0.0), "0");
  EXPECT_EQ(exact_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(exact_text(-0.0), "0");
  EXPECT_EQ(to_text(Scalar::integer(100000)), "100000");
  EXPECT_EQ(to_text(Scalar::logical(true)), "TRUE");
  EXPECT_EQ(to_text(Scalar{}), "NA");
}

TEST(Expression, AWholeNumberBeyondThoseOfRIsNoMissingValue) {
  const Expression largest = Expression::integer(2147483647);
  EXPECT_EQ(value(call(Add, largest, Expression::integer(1))).number, 2147483648);
  EXPECT_EQ(value(call(Multiply, largest, largest)).number, 2147483647.0 * 2147483647);
  EXPECT_EQ(value(call(AsInteger, number(5e9))).number, 5e9);
  const Scalar large[] = {Scalar::integer(5e9)};
  Expression condition = call(Greater, name("n"), number(3e9));
  const std::string names[] = {"n"};
  ASSERT_TRUE(condition.bind(names));
  EXPECT_TRUE(condition.is_true(large));
  Expression in = call(In, name("n"), call(Range, number(4999999999), number(5000000001)));
  ASSERT_TRUE(in.bind(names));
  EXPECT_TRUE(in.is_true(large));
  EXPECT_TRUE(Scalar::integer(HUGE_VAL).missing);
}

TEST(Expression, NamesItsParametersOnce) {
  const Expression expression = call(And, equals("b", "x"), call(Or, equals("a", "y"), name("b")));
  EXPECT_THAT(expression.names(), ElementsAre("b", "a"));
}

TEST(Expression, BindsNamesToPositions) {
  Expression expression = call(Greater, name("n"), number(2));
  const std::vector<std::string> names{"m", "n"};
  ASSERT_TRUE(expression.bind(names));
  const std::vector<Scalar> values{Scalar{}, Scalar::integer(3)};
  EXPECT_TRUE(expression.is_true(values));
  Expression unknown = name("q");
  const auto refused = unknown.bind(names);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message, "there is no parameter 'q'");
}

TEST(Expression, RefusesAWrongNumberOfOperands) {
  EXPECT_THROW(Expression::call(Not, {}), std::invalid_argument);
  EXPECT_THROW(Expression::call(Equal, {number(1)}), std::invalid_argument);
  EXPECT_THROW(Expression::call(Constant, {}), std::invalid_argument);
}

}  // namespace
}  // namespace swarmsmith
