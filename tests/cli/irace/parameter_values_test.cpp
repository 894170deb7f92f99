#include "cli/irace/parameter_values.h"

#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

TEST(ParameterValues, AreNumbersAndTexts) {
  const auto values =
      value_of(parse_parameter_values(R"({"a":1.5,"b": "x \"y\" \\ \u0009", "c":-2e-3})"));
  EXPECT_EQ(values, (ParameterValues{{"a", 1.5}, {"b", "x \"y\" \\ \t"}, {"c", -0.002}}));
  EXPECT_EQ(*parse_parameter_values("{}"), ParameterValues{});
  EXPECT_EQ(*parse_parameter_values(""), ParameterValues{});
}

TEST(ParameterValues, RefuseWhatIsNoObject) {
  for (const char* wrong : {"1", "{", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "{\"a\":1} x",
                            "{\"a\":[1]}", "{\"a\":\"x}", R"({"a":"\x"})", R"({"a":"\u12"})"}) {
    EXPECT_EQ(why_not(parse_parameter_values(wrong)).kind, ErrorKind::Corrupt) << wrong;
  }
}

}  // namespace
}  // namespace swarmsmith::cli
