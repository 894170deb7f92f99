#include "irace_core/parameter_space.h"

#include "irace_core/internal/rounding.h"
#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

/// The reason why these parameters are not a space.
std::string refusal(std::vector<Parameter> parameters, int digits = 4) {
  const auto space = ParameterSpace::make(std::move(parameters), {}, digits);
  return space ? "accepted" : to_string(space.error());
}

TEST(ParameterSpace, OrdersParametersBehindThoseTheyDependOn) {
  const ParameterSpace space =
      space_of({active_when(make_real("c", 0, 1), equals("b", "y")),
                active_when(make_categorical("b", {"x", "y"}), equals("a", "1")),
                make_categorical("a", {"1", "2"}), make_real("d", 0, 1)});
  EXPECT_THAT(space.hierarchy_order(), ElementsAre(2, 3, 1, 0));
  EXPECT_EQ(space.level(0), 3);
  EXPECT_EQ(space.level(3), 1);
}

TEST(ParameterSpace, CountsOnlyParametersThatVary) {
  const ParameterSpace space =
      space_of({make_categorical("only", {"x"}), make_real("r", 0, 1), make_ordinal("o", {"1"})});
  EXPECT_EQ(space.variable_count(), 1);
  EXPECT_TRUE(space.is_fixed(0));
  EXPECT_FALSE(space.is_fixed(1));
}

TEST(ParameterSpace, RefusesDomainsThatMakeNoSense) {
  EXPECT_THAT(refusal({make_real("r", 1, 1)}), HasSubstr("below the upper"));
  EXPECT_THAT(refusal({make_integer("i", 1.5, 3)}), HasSubstr("not a whole number"));
  EXPECT_THAT(refusal({make_real("r", 0, 1, true)}), HasSubstr("must be positive"));
  EXPECT_THAT(refusal({make_real("r", 0, 0.00001)}), HasSubstr("it needs digits = 5"));
  EXPECT_THAT(refusal({make_real("r", 0, 0.12345)}), HasSubstr("it needs digits = 5"));
  EXPECT_EQ(refusal({make_real("r", 0, 0.12345)}, 5), "accepted");
  EXPECT_THAT(refusal({make_categorical("c", {"a", "a"})}), HasSubstr("twice"));
  EXPECT_THAT(refusal({make_ordinal("o", {"1", "10", "2"})}), HasSubstr("increase"));
  EXPECT_THAT(refusal({make_categorical("c", {})}), HasSubstr("empty"));
}

TEST(ParameterSpace, RefusesNamesThatMakeNoSense) {
  EXPECT_THAT(refusal({make_real("a b", 0, 1)}), HasSubstr("letters"));
  EXPECT_THAT(refusal({make_real("a", 0, 1), make_real("a", 0, 1)}), HasSubstr("twice"));
  EXPECT_THAT(refusal({active_when(make_real("a", 0, 1), equals("b", "x"))}),
              HasSubstr("no parameter 'b'"));
  EXPECT_THAT(refusal({}), HasSubstr("needs a parameter"));
  EXPECT_THAT(refusal({make_categorical("c", {"x"})}), HasSubstr("single value"));
}

TEST(ParameterSpace, RefusesCircles) {
  EXPECT_THAT(refusal({active_when(make_categorical("a", {"x", "y"}), equals("b", "x")),
                       active_when(make_categorical("b", {"x", "y"}), equals("a", "x"))}),
              HasSubstr("depends on itself"));
  EXPECT_THAT(refusal({active_when(make_categorical("a", {"x", "y"}), equals("a", "x"))}),
              HasSubstr("depends on itself"));
}

TEST(ParameterSpace, RefusesBoundsThatAreNotArithmeticOnNumbers) {
  EXPECT_THAT(refusal({make_categorical("c", {"1", "2"}), {"r", "", Real{0.0, name("c")}, {}}}),
              HasSubstr("not numeric"));
  EXPECT_THAT(refusal({make_real("a", 0, 1),
                       {"r", "", Real{0.0, call(Operation::SquareRoot, name("a"))}, {}}}),
              HasSubstr("a bound may use"));
  EXPECT_THAT(refusal({make_real("a", 1, 2), {"r", "", Real{1.0, name("a"), true}, {}}}),
              HasSubstr("must not depend"));
}

TEST(ParameterSpace, EvaluatesConstantBoundsAtOnce) {
  const ParameterSpace space =
      space_of({{"i", "", Integer{1.0, call(Operation::Multiply, number(2), number(5))}, {}}});
  EXPECT_EQ(*space.constant_interval(0), (Interval{1, 10}));
}

TEST(ParameterSpace, EvaluatesDependentDomainsWithWhatTheyDependOn) {
  const Expression half = call(Operation::Divide, name("n"), number(2));
  const ParameterSpace space =
      space_of({make_integer("n", 1, 9), {"m", "", Integer{0.0, half}, {}}});
  Assignment values(space);
  EXPECT_EQ(space.interval(1, values).value(), std::nullopt);  // n is not set
  values.set(0, 5);
  EXPECT_EQ(space.interval(1, values).value(), (Interval{0, 2}));  // truncated
}

TEST(ParameterSpace, RefusesDomainsThatAreInfiniteHere) {
  const Expression inverse = call(Operation::Divide, number(10), name("n"));
  const ParameterSpace space =
      space_of({make_integer("n", 0, 9), {"x", "", Real{0.0, inverse}, {}}});
  Assignment values(space);
  values.set(0, 5);
  EXPECT_EQ(space.interval(1, values).value(), (Interval{0, 2}));
  values.set(0, 0);
  EXPECT_THAT(complaint_of(space.interval(1, values)),
              HasSubstr("x: a bound of its domain is infinite here"));
}

TEST(ParameterSpace, IntegersAreExactUpTo53BitsAndRefusedBeyond) {
  const ParameterSpace space = space_of(
      {make_integer("n", 0, irace::kLargestWhole),
       active_when(make_real("r", 0, 1), call(Operation::Greater, name("n"), number(3e9)))});
  EXPECT_EQ(to_fixed_text(space.scalar(0, irace::kLargestWhole).number), "9007199254740991");
  Assignment values(space);
  values.set(0, 5e9);
  EXPECT_TRUE(space.is_active(1, values));
  EXPECT_THAT(
      refusal({make_integer("n", 0, 18446744073709551615.0)}),
      HasSubstr("the bound 18446744073709551616 is too large: whole numbers are exact up to "
                "9007199254740991"));
  const ParameterSpace product =
      space_of({make_integer("n", 1, 1e10),
                {"m", "", Integer{0.0, call(Operation::Multiply, name("n"), name("n"))}, {}}});
  Assignment factors(product);
  factors.set(0, 1e5);
  EXPECT_EQ(product.interval(1, factors).value(), (Interval{0, 1e10}));
  factors.set(0, 1e10);
  EXPECT_THAT(product.interval(1, factors).error().message, HasSubstr("is too large"));
}

TEST(ParameterSpace, TabulatedConditionsAgreeWithTheirExpression) {
  const Expression missing_or_large = call(Operation::Or, call(Operation::IsMissing, name("n")),
                                           call(Operation::Greater, name("n"), number(3)));
  const ParameterSpace space = space_of({make_categorical("c", {"a", "b"}),
                                         active_when(make_integer("n", 1, 5), equals("c", "b")),
                                         active_when(make_real("r", 0, 1), missing_or_large)});
  Assignment values(space);
  values.set(0, 0);
  EXPECT_FALSE(space.is_active(1, values));
  EXPECT_TRUE(space.is_active(2, values));  // n is missing
  values.set(0, 1);
  EXPECT_TRUE(space.is_active(1, values));
  for (double n = 1; n <= 5; ++n) {
    values.set(1, n);
    EXPECT_EQ(space.is_active(2, values), n > 3) << n;
  }
}

TEST(ParameterSpace, ForbidsOnlyWhatIsTrue) {
  const ParameterSpace space = space_of(
      {make_categorical("c", {"a", "b"}), active_when(make_real("r", 0, 1), equals("c", "a"))},
      {call(Operation::Less, name("r"), number(0.5))});
  Configuration configuration(2);
  configuration.set(0, 1);
  EXPECT_FALSE(space.is_forbidden(configuration));  // r is missing
  configuration.set(0, 0);
  configuration.set(1, 0.4);
  EXPECT_TRUE(space.is_forbidden(configuration));
}

TEST(ParameterSpace, ChecksConfigurations) {
  const ParameterSpace space = space_of(
      {make_categorical("c", {"a", "b"}), active_when(make_integer("n", 1, 5), equals("c", "b"))});
  const auto verdict = [&](std::vector<double> values) {
    Configuration configuration(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      configuration.set(i, values[i]);
    const auto checked = space.check(configuration);
    return checked ? std::string("valid") : to_string(checked.error());
  };
  const double none = std::nan("");
  EXPECT_EQ(verdict({0, none}), "valid");
  EXPECT_EQ(verdict({1, 5}), "valid");
  EXPECT_THAT(verdict({0, 3}), HasSubstr("n: is inactive but has a value"));
  EXPECT_THAT(verdict({1, none}), HasSubstr("n: is active and needs a value"));
  EXPECT_THAT(verdict({1, 6}), HasSubstr("n: 6 is not in its domain (1, 5)"));
  EXPECT_THAT(verdict({1, 2.5}), HasSubstr("not a whole number"));
  EXPECT_THAT(verdict({2, none}), HasSubstr("c: 2 is not in its domain"));
  EXPECT_THAT(verdict({1}), HasSubstr("1 value,"));
}

TEST(ParameterSpace, SaysNumbersWithTheDigitsThatDecide) {
  Configuration configuration(1);
  configuration.set(0, 1.0000000000000002);
  EXPECT_THAT(complaint_of(space_of({make_real("r", 0, 1)}).check(configuration)),
              HasSubstr("1.0000000000000002 is not in its domain (0, 1)"));
  EXPECT_EQ(exact_text(1e-5), "0.00001");
  EXPECT_EQ(exact_text(-0.0), "0");
}

TEST(Configuration, TellsInactiveFromEveryValue) {
  Configuration a(2);
  Configuration b(2);
  EXPECT_EQ(a, b);
  a.set(0, 0);
  EXPECT_FALSE(a == b);
  EXPECT_NE(a.digest(), b.digest());
  b.set(0, -0.0);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.digest(), b.digest());
  b.deactivate(0);
  EXPECT_FALSE(b.is_active(0));
}

}  // namespace
}  // namespace swarmsmith
