#include "irace_core/parameter_space.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.h"
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
  const std::string order = ": the lower bound must be below the upper one";
  EXPECT_EQ(refusal({make_real("r", 1, 1)}), "r" + order);
  EXPECT_EQ(refusal({make_integer("i", 2, 1)}), "i" + order);
  EXPECT_EQ(refusal({make_integer("i", 1, 2)}), "accepted");
  EXPECT_EQ(refusal({make_integer("i", 1.5, 3)}), "i: the bound 1.5 is not a whole number");
  EXPECT_EQ(refusal({make_integer("i", 1, 3.5)}), "i: the bound 3.5 is not a whole number");
  EXPECT_EQ(refusal({make_real("r", 0, 1, true)}), "r: a logarithmic bound must be positive");
  EXPECT_EQ(refusal({make_real("r", 0.0001, 1, true)}), "accepted");
  EXPECT_EQ(refusal({make_real("r", 0, HUGE_VAL)}), "r: a bound is not finite");
  EXPECT_EQ(refusal({make_real("r", -HUGE_VAL, 0)}), "r: a bound is not finite");
  EXPECT_EQ(refusal({make_real("r", 0, 0.00001)}),
            "r: the bound 0.00001 does not fit digits = 4; it needs digits = 5");
  EXPECT_EQ(refusal({make_real("r", -0.12345, 1)}),
            "r: the bound -0.12345 does not fit digits = 4; it needs digits = 5");
  EXPECT_EQ(refusal({make_real("r", 0, 0.1234567)}, 2),
            "r: the bound 0.1234567 does not fit digits = 2; it needs digits = 7");
  EXPECT_EQ(refusal({make_real("r", 0, 0.000000007)}, 8),
            "r: the bound 0.000000007 does not fit digits = 8; it needs digits = 9");
  EXPECT_EQ(refusal({make_real("r", 0, 0.12345)}, 5), "accepted");
  EXPECT_EQ(refusal({make_real("r", 0.0001, 0.0002)}), "accepted");
  EXPECT_EQ(refusal({make_categorical("c", {"a", "b", "a"})}), "c: the value 'a' occurs twice");
  EXPECT_EQ(refusal({make_ordinal("o", {"b", "b"})}), "o: the value 'b' occurs twice");
  EXPECT_EQ(refusal({make_categorical("c", {})}), "c: the domain is empty");
  EXPECT_EQ(refusal({make_ordinal("o", {"1", "10", "2"})}),
            "o: the values of an ordinal parameter must increase");
  EXPECT_EQ(refusal({make_ordinal("o", {"1", "1.0", "2"})}), "accepted");
  EXPECT_EQ(refusal({make_ordinal("o", {"10", "few", "2"})}), "accepted") << "not all are numbers";
}

TEST(ParameterSpace, RefusesNamesThatMakeNoSense) {
  for (const std::string accepted : {"azAZ09_.", "größe"})
    EXPECT_EQ(refusal({make_real(accepted, 0, 1)}), "accepted") << accepted;
  const std::string rule = ": a name consists of letters, digits, '_' and '.'";
  EXPECT_EQ(refusal({make_real("", 0, 1)}), rule.substr(2));
  for (const char sign : std::string(" -/:@[^`{"))
    EXPECT_EQ(refusal({make_real(std::string("a") + sign, 0, 1)}), std::string("a") + sign + rule);
  EXPECT_THAT(refusal({make_real("a", 0, 1), make_real("a", 0, 1)}), HasSubstr("twice"));
  EXPECT_EQ(refusal({active_when(make_real("a", 0, 1), equals("b", "x"))}),
            "a: there is no parameter 'b'");
  EXPECT_EQ(refusal({{"a", "", Integer{0.0, name("b")}, {}}}), "a: there is no parameter 'b'");
  EXPECT_EQ(refusal({{"a", "", Real{name("b"), 1.0}, {}}}), "a: there is no parameter 'b'");
  EXPECT_THAT(refusal({}), HasSubstr("needs a parameter"));
  EXPECT_THAT(refusal({make_categorical("c", {"x"})}), HasSubstr("single value"));
}

TEST(ParameterSpace, RefusesBoundsThatAreNotNumbers) {
  const auto refused = [](Expression upper) {
    return refusal({make_categorical("c", {"1", "2"}),
                    make_real("a", 0, 1),
                    {"r", "", Real{0.0, std::move(upper)}, {}}});
  };
  EXPECT_EQ(refused(name("c")), "r: a bound depends on 'c', which is not numeric");
  EXPECT_EQ(refused(name("a")), "accepted");
  EXPECT_EQ(refused(call(Operation::Divide, number(0), number(0))), "r: a bound is not a number");
  EXPECT_EQ(refused(Expression::logical(true)), "accepted") << "1";
  EXPECT_EQ(refused(text("5")), "r: a bound may use + - * / %% min max round floor ceiling trunc");
  EXPECT_EQ(refusal({make_real("a", 1, 2), {"r", "", Real{1.0, name("a"), true}, {}}}),
            "r: a logarithmic domain must not depend on other parameters");
}

/// All operations on one or two numbers, by whether a bound may use them.
TEST(ParameterSpace, KnowsTheOperationsOfBounds) {
  using enum Operation;
  const std::vector<Operation> always = {Add, Subtract, Multiply, Divide, Modulo,  Negate,
                                         Min, Max,      Round,    Floor,  Ceiling, Truncate};
  const std::vector<Operation> constant = {Power, IntegerDivide, Abs, SquareRoot, Exp, Log};
  const std::vector<Operation> never = {Not,   And,     Or,        Xor,       Equal,  Less,
                                        Range, Combine, AsNumeric, AsInteger, AsText, IsMissing};
  const auto is_refused = [](const Expression& bound) {
    const std::string refused = refusal({make_real("a", 1, 2), {"r", "", Real{-100.0, bound}, {}}});
    return refused.starts_with("r: a bound may use + - * /");
  };
  for (const auto* operations : {&always, &constant, &never}) {
    for (const Operation operation : *operations) {
      const auto on = [operation](const Expression& x) {
        return arity(operation).least == 2 ? call(operation, x, number(2)) : call(operation, x);
      };
      const auto which = static_cast<int>(operation);
      EXPECT_EQ(is_refused(on(name("a"))), operations != &always) << which;
      EXPECT_EQ(is_refused(on(number(4))), operations == &never) << which;
      EXPECT_EQ(is_refused(call(Add, number(1), on(name("a")))), operations != &always) << which;
      EXPECT_EQ(is_refused(call(Add, on(number(4)), number(1))), operations == &never) << which;
    }
  }
}

/// So many decimals that a number has no more of them.
TEST(Rounding, KeepsWhatHasNoMoreDecimals) {
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.uniform(-1e6, 1e6);
    EXPECT_EQ(irace::round_to_digits(value, 15), value);
  }
  for (const double value : {1e300, -1e300, HUGE_VAL, -HUGE_VAL, 0.0})
    EXPECT_EQ(irace::round_to_digits(value, 15), value);
  EXPECT_TRUE(std::isnan(irace::round_to_digits(std::nan(""), 4)));
  EXPECT_FALSE(std::signbit(irace::round_to_digits(-0.001, 2))) << "0 has no sign";
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
