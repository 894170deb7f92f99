#include "cli/irace/parameter_values.h"

#include <gtest/gtest.h>

namespace swarmsmith::cli {
namespace {

TEST(ParameterValues, AreNumbersAndTexts) {
  const auto values = parse_parameter_values(R"({"a":1.5,"b": "x \"y\" \\ \u0009", "c":-2e-3})");
  ASSERT_TRUE(values);
  EXPECT_EQ(*values, (ParameterValues{{"a", 1.5}, {"b", "x \"y\" \\ \t"}, {"c", -0.002}}));
  EXPECT_EQ(*parse_parameter_values("{}"), ParameterValues{});
  EXPECT_EQ(*parse_parameter_values(""), ParameterValues{});
}

TEST(ParameterValues, RefuseWhatIsNoObject) {
  for (const char* wrong : {"1", "{", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "{\"a\":1} x",
                            "{\"a\":[1]}", "{\"a\":\"x}", R"({"a":"\x"})", R"({"a":"\u12"})"}) {
    const auto values = parse_parameter_values(wrong);
    ASSERT_FALSE(values) << wrong;
    EXPECT_EQ(values.error().kind, ErrorKind::Corrupt);
  }
}

}  // namespace
}  // namespace swarmsmith::cli
