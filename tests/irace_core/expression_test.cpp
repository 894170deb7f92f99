#include "irace_core/expression.h"

#include <cmath>
#include <stdexcept>

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

TEST(Expression, WritesNumbersInTheShorterNotation) {
  EXPECT_EQ(to_text(Scalar::real(100000)), "1e+05");
  EXPECT_EQ(to_text(Scalar::real(123456)), "123456");
  EXPECT_EQ(to_text(Scalar::real(0.0001)), "1e-04");
  EXPECT_EQ(to_text(Scalar::real(0.1 + 0.2)), "0.3");
  EXPECT_EQ(to_text(Scalar::real(-1.5e-7)), "-1.5e-07");
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

TEST(Expression, CalculatesAsRDoes) {
  EXPECT_EQ(value(call(Power, number(2), negate_of(2))).number, 0.25);
  EXPECT_EQ(value(call(Modulo, number(5.5), number(2))).number, 1.5);
  EXPECT_TRUE(value(call(Modulo, Expression::integer(5), Expression::integer(0))).missing);
  EXPECT_TRUE(value(call(Add, text("1"), number(1))).missing);
  EXPECT_EQ(value(call(Round, number(2.345), number(1))).number, 2.3);
  EXPECT_EQ(value(call(Log, number(8), number(2))).number, 3);
  EXPECT_EQ(value(call(Exp, number(0))).number, 1);
  EXPECT_EQ(value(call(AsNumeric, text(" 1e3 "))).number, 1000);
  EXPECT_TRUE(value(call(AsNumeric, text("1x"))).missing);
  EXPECT_EQ(value(call(AsText, number(0.5))).text, "0.5");
  EXPECT_EQ(value(call(AsInteger, number(-2.7))).number, -2);
  EXPECT_EQ(value(call(Max, number(1.5), number(2.5))).number, 2.5);
  EXPECT_EQ(value(call(Min, Expression::logical(true), Expression::logical(true))),
            Scalar::integer(1));
}

TEST(Expression, RepeatsTheShorterVector) {
  const Expression many = call(Range, number(1), number(4));
  const Values values = call(Add, many, call(Range, number(0), number(1))).evaluate({});
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[3].number, 5);
  EXPECT_EQ(call(Range, number(3), number(1)).evaluate({})[2].number, 1);
}

TEST(Expression, ChoosesElementByElement) {
  const Expression tests = Expression::call(
      Combine, {Expression::logical(true), Expression::missing(), Expression::logical(false)});
  const Values values = call(IfElse, tests, number(1), number(2)).evaluate({});
  EXPECT_EQ(values[0].number, 1);
  EXPECT_TRUE(values[1].missing);
  EXPECT_EQ(values[2].number, 2);
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
