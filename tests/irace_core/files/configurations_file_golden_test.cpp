#include <map>

#include <sstream>
#include <string>

#include "irace_core/files/command_line_text.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/parameter_file.h"
#include "tests/irace_core/files/golden_files.h"
#include "tests/irace_core/golden.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

ParameterSpace golden_space() {
  return parse_parameter_file({.parameters = golden_text("configurations/parameters.txt")})->space;
}

TEST(ConfigurationsFileGolden, ReadsWhatRReads) {
  const ParameterSpace space = golden_space();
  const nlohmann::json files = golden("configurations.json");
  int read_files = 0;
  for (const auto& [name, wanted] : files.items()) {
    if (!wanted["valid"].get<bool>()) continue;
    SCOPED_TRACE(name);
    ++read_files;
    const auto found =
        value_of(parse_configurations_file(golden_text("configurations/" + name + ".txt"), space));
    ASSERT_EQ(found.size(), wanted["configurations"].size());
    for (std::size_t c = 0; c < found.size(); ++c) {
      EXPECT_TRUE(space.check(found[c]));
      for (std::size_t i = 0; i < space.size(); ++i) {
        const auto& value = wanted["configurations"][c][space[i].name];
        ASSERT_EQ(found[c].is_active(i), !value.is_null()) << space[i].name;
        if (value.is_null()) continue;
        if (space.is_numeric(i)) {
          EXPECT_EQ(found[c][i], value.get<double>());
        } else {
          EXPECT_EQ(value_text(space, i, found[c][i]), value.get<std::string>());
        }
      }
    }
  }
  EXPECT_EQ(read_files, 7);
}

TEST(ConfigurationsFileGolden, RefusesWhatRRefusesForTheSameReason) {
  const std::map<std::string, std::string> reasons = {
      {"bad_unknown_column", "1:14: there is no parameter 'zz'"},
      {"bad_missing_column", "1:1: the first line must name every parameter; these are missing: o"},
      {"bad_out_of_range", "2:3: configuration 1, parameter 'x': 11 is not in its domain (0, 10)"},
      {"bad_not_integer", "2:5: configuration 1, parameter 'n': 2.5 is not a whole number"},
      {"bad_inactive_given",
       "2:5: configuration 1, parameter 'n': must be NA, because its condition does not hold (algo "
       "== \"a\"), found 2"},
      {"bad_active_na", "2:3: configuration 1, parameter 'x': is active and needs a value, found"},
      {"bad_category",
       "2:1: configuration 1, parameter 'algo': 'c' is not among its values: a, b, fix me"},
      {"bad_dependent", "2:7: configuration 1, parameter 'd': 6 is not in its domain (1, 5)"},
      {"bad_duplicate", "3:1: configuration 2 is the same as configuration 1"},
      {"bad_text_number", "2:3: configuration 1, parameter 'x': 'one' is not a number"},
      {"bad_fixed_value", "2:13: configuration 1, parameter 'k': 'other' is not among its values"},
      {"bad_row_length", "2:1: expected 5 fields, as many as the first line has names, found 4"},
  };
  const ParameterSpace space = golden_space();
  const nlohmann::json files = golden("configurations.json");
  std::size_t refused = 0;
  for (const auto& [name, wanted] : files.items()) {
    if (wanted["valid"].get<bool>()) continue;
    SCOPED_TRACE(name + ", R says: " + wanted["error"].get<std::string>());
    ++refused;
    const auto found =
        parse_configurations_file(golden_text("configurations/" + name + ".txt"), space);
    ASSERT_FALSE(found);
    ASSERT_EQ(reasons.count(name), 1U);
    EXPECT_THAT(to_string(found.error()), HasSubstr(name + ".txt:" + reasons.at(name)));
  }
  EXPECT_EQ(refused, reasons.size());
}

TEST(CommandLineTextGolden, IsThatOfR) {
  const auto file = value_of(parse_parameter_file(
      {.parameters = {"a \"--a \" c (x,y)\nb \"--b=\" i (1,100000000)\nc \"-c\" r (0,1000000)\n"
                      "d \"\" r (0, 10)\n[global]\ndigits=15\n",
                      "p"}}));
  const nlohmann::json cases = golden("model.json", "command_line");
  for (const auto& given : cases) {
    Configuration configuration(4);
    configuration.set(0, given["values"]["a"] == "x" ? 0 : 1);
    for (std::size_t i = 1; i < 4; ++i) {
      const auto& value = given["values"][file.space[i].name];
      if (!value.is_null()) configuration.set(i, value);
    }
    EXPECT_EQ(command_line_text(file.space, configuration), given["line"].get<std::string>());
  }
  EXPECT_GT(cases.size(), 5U);
}

/// What R wrote is read as numbers, and must come out the same.
TEST(AclibTextGolden, IsThatOfR) {
  const auto file = value_of(parse_parameter_file(
      {.parameters = {"cost \"cost\" r (0,1)\nbig \"big\" i (100000,200000)\n"
                      "tiny \"tiny\" r,log (0.00001,0.1)\nwide \"wide\" r (0,100000000)\n"
                      "count \"count\" i (1,12)\n[global]\ndigits=15\n",
                      "p"}}));
  std::istringstream lines(golden_text("aclib_calls.txt").text);
  int checked = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    Configuration configuration(5);
    std::istringstream words(line);
    std::string name;
    std::string value;
    for (std::size_t i = 0; words >> name >> value; ++i)
      configuration.set(i, std::stod(value));
    EXPECT_EQ(aclib_text(file.space, configuration), line);
    ++checked;
  }
  EXPECT_GE(checked, 10);
}

TEST(AclibTextGolden, WritesWhatIsActiveAndLargeNumbersAsRDoes) {
  const auto file =
      parse_parameter_file({.parameters = {"alg \"alg\" c (a,b)\nbig \"big\" i (1,200000)\n"
                                           "only \"only\" i (1,3) | alg == \"a\"\n",
                                           "p"}});
  Configuration configuration(3);
  configuration.set(0, 1);
  configuration.set(1, 100000);
  EXPECT_EQ(aclib_text(file->space, configuration), "-alg b -big 1e+05");
}

}  // namespace
}  // namespace swarmsmith
