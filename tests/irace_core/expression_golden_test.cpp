#include <gtest/gtest.h>

#include <map>

#include "irace_core/expression.h"
#include "tests/irace_core/golden.h"
#include "tests/irace_core/spaces.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;
using enum Operation;

Expression list(std::vector<Expression> values) {
  return Expression::call(Combine, std::move(values));
}
Expression truth(bool value) {
  return Expression::logical(value);
}
Expression power(Expression a, Expression b) {
  return call(Power, std::move(a), std::move(b));
}
Expression negative(double value) {
  return call(Negate, number(value));
}

/// The trees of the golden expressions, by their text.
std::map<std::string, Expression> trees_of_logic() {
  return {
      {"m == \"x\"", equals("m", "x")},
      {"is.na(m)", call(IsMissing, name("m"))},
      {"m == \"x\" | TRUE", call(Or, equals("m", "x"), truth(true))},
      {"m == \"x\" & FALSE", call(And, equals("m", "x"), truth(false))},
      {"z > 1", call(Greater, name("z"), number(1))},
      {"!is.na(z) & z > 1",
       call(And, call(Not, call(IsMissing, name("z"))), call(Greater, name("z"), number(1)))},
      {"!(i == 5) | r < 1",
       call(Or, call(Not, call(Equal, name("i"), number(5))), call(Less, name("r"), number(1)))},
      {"! i == 5 & r < 1",
       call(And, call(Not, call(Equal, name("i"), number(5))), call(Less, name("r"), number(1)))},
      {"i >= 5 & i <= 5",
       call(And, call(GreaterEqual, name("i"), number(5)), call(LessEqual, name("i"), number(5)))},
      {"(i > 3) & !(s == \"y\")",
       call(And, call(Greater, name("i"), number(3)), call(Not, equals("s", "y")))},
      {"s != \"x\"", call(NotEqual, name("s"), text("x"))},
      {"T & !F", call(And, truth(true), call(Not, truth(false)))},
      {"xor(TRUE, FALSE)", call(Xor, truth(true), truth(false))},
      {"NA & FALSE", call(And, Expression::missing(), truth(false))},
      {"NA | TRUE", call(Or, Expression::missing(), truth(true))},
      {"a == \"1\" | b == \"2\" & s == \"y\"",
       call(Or, equals("a", "1"), call(And, equals("b", "2"), equals("s", "y")))},
      {"ifelse(i > 3, TRUE, FALSE)",
       call(IfElse, call(Greater, name("i"), number(3)), truth(true), truth(false))},
  };
}

std::map<std::string, Expression> trees_of_texts() {
  return {
      {"a == 1", call(Equal, name("a"), number(1))},
      {"a %in% c(1,2)", Expression::in(name("a"), {number(1), number(2)})},
      {"b > 2", call(Greater, name("b"), number(2))},
      {"as.numeric(b) > 2", call(Greater, call(AsNumeric, name("b")), number(2))},
      {"b > \"2\"", call(Greater, name("b"), text("2"))},
      {"s %in% c(\"x\",\"y\")", Expression::in(name("s"), {text("x"), text("y")})},
      {"m %in% c(\"x\")", Expression::in(name("m"), {text("x")})},
      {"r == \"0.5\"", call(Equal, name("r"), text("0.5"))},
      {"i == \"5\"", call(Equal, name("i"), text("5"))},
      {"a < s", call(Less, name("a"), name("s"))},
      {"as.integer(\"7\") == 7", call(Equal, call(AsInteger, text("7")), number(7))},
      {"as.numeric(s) > 1", call(Greater, call(AsNumeric, name("s")), number(1))},
      {"1:3 %in% 2", call(In, call(Range, number(1), number(3)), number(2))},
      {"big == \"1e+05\"", call(Equal, name("big"), text("1e+05"))},
      {"big == \"100000\"", call(Equal, name("big"), text("100000"))},
      {"100000 == \"1e+05\"", call(Equal, number(100000), text("1e+05"))},
      {"a == TRUE", call(Equal, name("a"), truth(true))},
      {"\"apple\" < \"Banana\"", call(Less, text("apple"), text("Banana"))},
      {"i %in% c(1, 5) & s %in% \"x\"", call(And, call(In, name("i"), list({number(1), number(5)})),
                                             call(In, name("s"), text("x")))},
  };
}

std::map<std::string, Expression> trees_of_arithmetic() {
  return {
      {"i %% 2 == 1", call(Equal, call(Modulo, name("i"), number(2)), number(1))},
      {"i %/% 2 == 2", call(Equal, call(IntegerDivide, name("i"), number(2)), number(2))},
      {"-i^2 == -25", call(Equal, call(Negate, power(name("i"), number(2))), negative(25))},
      {"2^3^2 == 512", call(Equal, power(number(2), power(number(3), number(2))), number(512))},
      {"-7 %% 3 == 2", call(Equal, call(Modulo, negative(7), number(3)), number(2))},
      {"-7 %/% 3 == -3", call(Equal, call(IntegerDivide, negative(7), number(3)), negative(3))},
      {"min(i, 10) == 5", call(Equal, call(Min, name("i"), number(10)), number(5))},
      {"max(i, r) == 5", call(Equal, call(Max, name("i"), name("r")), number(5))},
      {"round(2.5) == 2", call(Equal, call(Round, number(2.5)), number(2))},
      {"floor(-1.5) == -2", call(Equal, call(Floor, negative(1.5)), negative(2))},
      {"ceiling(-1.5) == -1", call(Equal, call(Ceiling, negative(1.5)), negative(1))},
      {"trunc(-1.5) == -1", call(Equal, call(Truncate, negative(1.5)), negative(1))},
      {"r + i * 2 == 10.5",
       call(Equal, call(Add, name("r"), call(Multiply, name("i"), number(2))), number(10.5))},
      {"abs(neg) == 3", call(Equal, call(Abs, name("neg")), number(3))},
      {"i == 5L", call(Equal, name("i"), Expression::integer(5))},
      {"0.1 + 0.2 == 0.3", call(Equal, call(Add, number(0.1), number(0.2)), number(0.3))},
      {"sqrt(16) == 4", call(Equal, call(SquareRoot, number(16)), number(4))},
      {"log(1) == 0", call(Equal, call(Log, number(1)), number(0))},
  };
}

/// The variables of the golden file with their R types.
struct Environment {
  explicit Environment(const nlohmann::json& json) {
    for (const auto& [id, value] : json["environment"].items()) {
      const std::string type = json["types"][id];
      names.push_back(id);
      if (type == "character") {
        values.push_back(value.is_null() ? Scalar::missing_of(Scalar::Type::Text)
                                         : Scalar::of_text(value));
      } else if (type == "integer") {
        values.push_back(Scalar::integer(value));
      } else {
        values.push_back(Scalar::real(number_or(value, kNotEvaluated)));
      }
    }
  }
  std::vector<std::string> names;
  std::vector<Scalar> values;
};

nlohmann::json to_json(const Scalar& value) {
  if (value.missing) return "NA";
  return value.number != 0;
}

TEST(ExpressionGolden, ValuesAreThoseOfR) {
  const nlohmann::json json = golden("expressions.json");
  const Environment environment(json);
  std::map<std::string, Expression> trees = trees_of_logic();
  trees.merge(trees_of_texts());
  trees.merge(trees_of_arithmetic());
  for (const auto& given : json["cases"]) {
    SCOPED_TRACE(given["expression"].get<std::string>());
    const auto found = trees.find(given["expression"]);
    ASSERT_NE(found, trees.end());
    ASSERT_TRUE(found->second.bind(environment.names));
    const Values values = found->second.evaluate(environment.values);
    nlohmann::json ours = to_json(values[0]);
    if (values.size() > 1) {
      ours = nlohmann::json::array();
      for (std::size_t i = 0; i < values.size(); ++i)
        ours.push_back(to_json(values[i]));
    }
    EXPECT_EQ(ours, given["value"]);
    EXPECT_EQ(found->second.is_true(environment.values), given["active"]);
  }
  EXPECT_EQ(trees.size(), json["cases"].size());
}

}  // namespace
}  // namespace swarmsmith
