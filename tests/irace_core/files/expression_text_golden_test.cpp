#include "irace_core/files/expression_text.h"
#include "tests/irace_core/golden.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

nlohmann::json to_json(const Values& values) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].missing) {
      all.push_back("NA");
    } else {
      all.push_back(values[i].number != 0);
    }
  }
  return values.size() == 1 ? all[0] : all;
}

/// Every expression from its text, and once more from what we print of it.
TEST(ExpressionTextGolden, ValuesAreThoseOfR) {
  const nlohmann::json json = golden("expressions.json");
  std::vector<std::string> names;
  std::vector<Scalar> variables;
  for (const auto& [name, value] : json["environment"].items()) {
    const std::string type = json["types"][name];
    names.push_back(name);
    if (type == "character") {
      variables.push_back(value.is_null() ? Scalar::missing_of(Scalar::Type::Text)
                                          : Scalar::of_text(value));
    } else if (type == "integer") {
      variables.push_back(Scalar::integer(value));
    } else {
      variables.push_back(Scalar::real(number_or(value, kNotEvaluated)));
    }
  }
  std::vector<Error> warnings;
  const auto read = [&](const std::string& text) {
    return parse_expression(text, names, ExpressionUse::Value, {}, warnings);
  };
  for (const auto& given : json["cases"]) {
    SCOPED_TRACE(given["expression"].get<std::string>());
    auto expression = value_of(read(given["expression"]));
    auto again = read(print(expression));
    ASSERT_TRUE(again) << print(expression) << ": " << to_string(again.error());
    EXPECT_EQ(*again, expression) << print(expression);
    for (Expression* one : {&expression, &*again}) {
      ASSERT_TRUE(one->bind(names));
      EXPECT_EQ(to_json(one->evaluate(variables)), given["value"]);
      EXPECT_EQ(one->is_true(variables), given["active"].get<bool>());
    }
  }
  EXPECT_GT(json["cases"].size(), 50U);
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace swarmsmith
