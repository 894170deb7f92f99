#include "irace_core/files/options.h"

#include <map>
#include <set>

#include "base/rng.h"
#include "base/text/csv.h"
#include "base/text/whole_file.h"
#include "irace_core/files/internal/setup_fields.h"
#include "irace_core/files/number_text.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

TEST(IraceOptions, NamesAndSwitchesOccurOnce) {
  std::set<std::string_view> seen;
  for (const IraceOption& option : not_empty(irace_options())) {
    for (const std::string_view word : {option.name, option.short_switch, option.long_switch}) {
      EXPECT_TRUE(word.empty() || seen.insert(word).second) << word;
    }
    EXPECT_FALSE(option.title().empty());
  }
}

/// Those of irace 4.4.3 (tests/golden/irace/README.md), by name, or switch where they have none:
/// the switches and the default.
std::map<std::string, std::vector<std::string>> options_of_r() {
  const auto text = read_whole_file(std::filesystem::path(SWARMSMITH_SOURCE_DIR) /
                                    "tests/golden/irace/options.csv");
  EXPECT_TRUE(text);
  std::map<std::string, std::vector<std::string>> options;
  CsvReader reader(*text);
  reader.next();  // the headline
  while (!reader.at_end()) {
    const auto cells = reader.next();
    const std::string& name = cells->at(0);
    options[name.starts_with('.') ? cells->at(3) : name] = {cells->at(2), cells->at(3),
                                                            cells->at(4)};
  }
  return options;
}

TEST(IraceOptions, AreThoseOfRWithTheirSwitchesAndDefaults) {
  const auto of_r = options_of_r();
  ASSERT_EQ(of_r.size(), 69U);
  for (const auto& [name, row] : of_r) {
    const bool is_switch = name.starts_with('-');
    const IraceOption* option = is_switch ? find_irace_switch(name) : find_irace_option(name);
    ASSERT_NE(option, nullptr) << name;
    EXPECT_EQ(option->short_switch, row[0]) << name;
    EXPECT_EQ(option->long_switch, row[1]) << name;
    // All cores are used where nothing is said: the results are the same (docs/irace-files.md).
    if (option->takes_value() && name != "parallel") {
      EXPECT_EQ(option->initial, row[2]) << name;
    }
  }
}

/// What R has as functions or programs of their own, and what a store and a terminal need. The list
/// is frozen: a tuner has irace's options.
TEST(IraceOptions, ThatRDoesNotHaveAreThese) {
  const auto of_r = options_of_r();
  std::vector<std::string> own;
  for (const IraceOption& option : not_empty(irace_options())) {
    if (option.group != IraceGroup::Old && !of_r.contains(std::string(option.title())))
      own.emplace_back(option.title());
  }
  EXPECT_THAT(own,
              ElementsAre("--psrace", "--psrace-max-experiments", "--psrace-ids", "--psrace-elites",
                          "--ablation", "--ablation-type", "--ablation-source", "--ablation-target",
                          "--ablation-instances", "--ablation-csv", "--workers", "--on-failure",
                          "--store", "--json", "--verbose", "--no-color"));
}

TEST(IraceOptions, DefaultsAreValuesOfTheirKind) {
  for (const IraceOption& option : not_empty(irace_options())) {
    if (!option.takes_value() || option.initial.empty()) continue;
    EXPECT_TRUE(irace_value_of(option, option.initial)) << option.title();
  }
}

TEST(IraceOptions, TheTablesDefaultsAreThoseOfASetup) {
  const IraceSetup fresh;
  for (const irace::SetupField& field : not_empty(irace::setup_fields())) {
    const IraceOption* option = find_irace_option(field.name);
    ASSERT_NE(option, nullptr) << field.name;
    if (option->is_path()) continue;  // they depend on the folder
    IraceSetup set;
    const auto value = irace_value_of(*option, option->initial);
    ASSERT_TRUE(value) << field.name;
    field.set(set, *value);
    EXPECT_EQ(irace_value_text(field.get(set)), irace_value_text(field.get(fresh))) << field.name;
  }
}

TEST(IraceOptions, EverySupportedOptionOfScenarioFilesHasAPlaceInTheSetup) {
  std::set<std::string_view> placed = {"scenarioFile",       "instances",     "trainInstancesDir",
                                       "trainInstancesFile", "testInstances", "testInstancesDir",
                                       "testInstancesFile"};
  for (const irace::SetupField& field : irace::setup_fields())
    placed.insert(field.name);
  for (const IraceOption& option : not_empty(irace_options())) {
    if (option.meaning != IraceMeaning::Supported || option.name.empty()) continue;
    EXPECT_TRUE(placed.contains(option.name)) << option.name;
  }
}

TEST(IraceOptions, OlderNamesLeadToOptionsThatExist) {
  for (const IraceOption& option : not_empty(irace_options())) {
    if (option.meaning != IraceMeaning::Gone) continue;
    EXPECT_NE(find_irace_option(option.remark), nullptr) << option.name;
  }
}

struct Case {
  const char* option;
  const char* text;
  const char* value;  ///< as a scenario file writes it; null for an error
};

class IraceOptionValues : public testing::TestWithParam<Case> {};

TEST_P(IraceOptionValues, AreCheckedByKind) {
  const IraceOption& option = *find_irace_option(GetParam().option);
  const auto value = irace_value_of(option, GetParam().text);
  ASSERT_EQ(value.has_value(), GetParam().value != nullptr) << GetParam().text;
  if (value) {
    EXPECT_EQ(irace_value_text(*value), GetParam().value);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, IraceOptionValues,
    testing::Values(
        Case{"elitist", "1", "1"}, Case{"elitist", "0", "0"}, Case{"elitist", "TRUE", "1"},
        Case{"elitist", "2", nullptr}, Case{"elitist", "", "NULL"}, Case{"capping", "NA", "NULL"},
        Case{"maxExperiments", "1e3", "1000"}, Case{"maxExperiments", "1000L", "1000"},
        Case{"maxExperiments", "1000.5", nullptr}, Case{"maxExperiments", "-1", nullptr},
        Case{"maxExperiments", "1e17", nullptr}, Case{"maxExperiments", "many", nullptr},
        Case{"maxExperiments", "", "NULL"}, Case{"maxExperiments", "inf", nullptr},
        Case{"maxExperiments", "0x10", "16"}, Case{"confidence", "0.99", "0.99"},
        Case{"confidence", "1.5", nullptr}, Case{"confidence", "nan", nullptr},
        Case{"testType", "friedman", "\"F-test\""}, Case{"testType", "T.Holm", "\"t-test-holm\""},
        Case{"testType", "z-test", nullptr}, Case{"testType", "", "NULL"},
        Case{"batchmode", "0", "\"0\""}, Case{"batchmode", "SLURM", "\"slurm\""},
        Case{"boundMax", "2.5", nullptr}, Case{"postselection", "0.1", "0.1"},
        Case{"logFile", "", "\"\""}, Case{"targetRunner", "a \"b\"", "\"a \\\"b\\\"\""}));

TEST(IraceOptions, WrongWordsGetASuggestion) {
  const Error value = why_not(irace_value_of(*find_irace_option("cappingType"), "medain"));
  EXPECT_THAT(value.message, HasSubstr("median, mean, worst, best"));
  EXPECT_THAT(value.message, HasSubstr("did you mean \"median\""));
}

TEST(IraceOptions, NamesOfFieldsBecomeThoseOfOptions) {
  EXPECT_EQ(with_irace_option_names("min_nb_survival and max_time, but not first_tests or a_b"),
            "minNbSurvival and maxTime, but not first_tests or a_b");
  EXPECT_EQ(with_irace_option_names("needs elitist; mu_"), "needs elitist; mu_");
  const Error error =
      with_irace_option_names(Error{ErrorKind::BadInput, "is 3, each_test 2", "first_test"});
  EXPECT_EQ(to_string(error), "firstTest: is 3, eachTest 2");
}

TEST(IraceOptions, HelpListsEverySwitchThatCanBeUsedWithinEightyColumns) {
  const std::string help = irace_option_help();
  for (const IraceOption& option : irace_options()) {
    if (option.long_switch.empty()) continue;
    const bool is_listed = help.find(std::string(option.long_switch)) != std::string::npos;
    EXPECT_EQ(is_listed, option.meaning != IraceMeaning::Gone) << option.long_switch;
  }
  std::size_t begin = 0;
  while (begin < help.size()) {
    const std::size_t end = help.find('\n', begin);
    const std::string line = help.substr(begin, end - begin);
    // Only the default of targetCmdline is a long line of its own words.
    EXPECT_LE(line.size(), 80U) << line;
    begin = end + 1;
  }
}

TEST(IraceOptions, TheDocumentationHasTheTable) {
  const auto page = value_of(
      read_whole_file(std::filesystem::path(SWARMSMITH_SOURCE_DIR) / "docs/irace-options.md"));
  EXPECT_THAT(page, HasSubstr(irace_option_table()));
}

TEST(NumberText, ShortestTextsReadBack) {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double number = rng.uniform(-1, 1) * static_cast<double>(rng.below(1'000'000) + 1);
    EXPECT_EQ(number_of(shortest_text(number)), number);
  }
}

TEST(NumberText, WhatIsNoNumberIsNothing) {
  for (const char* text :
       {"", " 1", "1 ", "--1", "+-1", "-", "0x", "1e", "1,5", "inf", "nan", "L", "1LL", "1e999"}) {
    EXPECT_EQ(number_of(text), std::nullopt) << text;
  }
  EXPECT_EQ(number_of("+1"), 1);
  EXPECT_EQ(number_of("-1e-2"), -0.01);
}

}  // namespace
}  // namespace swarmsmith
