#include "irace_core/files/configurations_file.h"

#include "irace_core/files/parameter_file.h"
#include "tests/irace_core/files/random_spaces.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

ParameterSpace space_of(std::string text) {
  return parse_parameter_file({.parameters = {std::move(text), "p.txt"}})->space;
}
std::string error_of(const ParameterSpace& space, std::string text) {
  const auto found = parse_configurations_file({std::move(text), "c.txt"}, space);
  return found ? "none" : to_string(found.error());
}

TEST(ConfigurationsFile, SaysWhereAndWhat) {
  const ParameterSpace space =
      space_of("a \"\" i (1,9)\nb \"\" r (0,a) | a > 3\nc \"\" i (a, 5) | a < 9\nk \"\" c (only)");
  EXPECT_EQ(error_of(space, ""), "c.txt:1:1: expected a first line with the parameters' names");
  EXPECT_EQ(error_of(space, "a b c a\n"), "c.txt:1:7: the name 'a' occurs twice");
  EXPECT_EQ(error_of(space, "a B c\n"),
            "c.txt:1:3: there is no parameter 'B' (did you mean \"b\"?)");
  EXPECT_EQ(error_of(space, "a b c\n1 NA 'x\n"),
            "c.txt:2:6: expected a closing quote ', found \"'x\"");
  EXPECT_EQ(error_of(space, "a b c\n6 1 5\n"),
            "c.txt:2:5: configuration 1, parameter 'c': the domain (6, 5) is empty here: "
            "keep the bounds apart, as by min() and max()");
  EXPECT_EQ(error_of(space, "a b c\n6 1 NA\n"),
            "c.txt:2:5: configuration 1, parameter 'c': the domain (6, 5) is empty here: "
            "keep the bounds apart, as by min() and max()");
  EXPECT_EQ(error_of(space, "a b c\n9 1 NA\n"), "none") << "empty, but inactive";
  EXPECT_EQ(error_of(space, "a b c\n4 1 4\n4 2 5 6 7\n"),
            "c.txt:3:1: expected 3 fields, as many as the first line has names, found 5");
}

TEST(ConfigurationsFile, ReadsTheTablesThatRWrites) {
  const ParameterSpace space = space_of("a \"\" c (\"it's\", say \"x, NA)\nb \"\" r (0,1)");
  const auto found = value_of(parse_configurations_file(
      {"\"a\" \"b\"\r\n\"1\" \"it's\" 0.25\r\n\"2\" \"NA\" 1e-1 # quoted, so the value\r\n", "c"},
      space));
  EXPECT_EQ(found[0].choice(0), 0U);
  EXPECT_EQ(found[1].choice(0), 2U);
  EXPECT_EQ(found[1][1], 0.1);
}

TEST(ConfigurationsFile, AnEmptyTextIsMissingUnlessItIsAValue) {
  const ParameterSpace space =
      space_of("a \"\" c (x, \"\")\nb \"\" r (0,1) | a == \"x\"\nc \"\" c (u, v) | a == \"x\"");
  const auto found =
      value_of(parse_configurations_file({"a b c\n\"\" \"\" ''\nx 0.5 u\n", "c"}, space));
  EXPECT_EQ(found[0].choice(0), 1U);
  EXPECT_FALSE(found[0].is_active(1));
  EXPECT_FALSE(found[0].is_active(2));
  EXPECT_THAT(error_of(space, "a b c\nx 0.5 \"\"\n"),
              HasSubstr("parameter 'c': is active and needs a value"));
}

TEST(ConfigurationsFile, WhatIsPrintedReadsBackAsTheSame) {
  Rng rng(234);
  std::size_t compared = 0;
  for (int i = 0; i < 500; ++i) {
    const ParameterSpace space = testing::random_space(rng);
    std::vector<Configuration> configurations;
    for (int c = 0; c < 5; ++c) {
      auto one = testing::random_configuration(space, rng);
      const bool known = one && std::count(configurations.begin(), configurations.end(), *one) > 0;
      if (one && !known) configurations.push_back(std::move(*one));
    }
    const auto text = value_of(print_configurations_file(space, configurations));
    const auto again = parse_configurations_file({text, "c"}, space);
    ASSERT_TRUE(again) << to_string(again.error()) << "\n" << text;
    EXPECT_EQ(*again, configurations) << text;
    compared += configurations.size();
  }
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace swarmsmith
