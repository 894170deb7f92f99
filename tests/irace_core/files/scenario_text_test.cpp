#include "irace_core/files/scenario_text.h"

#include "base/rng.h"
#include "irace_core/files/internal/setup_fields.h"
#include "irace_core/files/internal/setup_work.h"
#include "irace_core/files/scenario_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::string random_text(Rng& rng) {
  constexpr std::string_view kLetters = "ab \t\n\"'\\#{}=;,|%$\xc3\xa4";
  std::string text = "x";
  for (std::uint64_t i = rng.below(10); i > 0; --i)
    text += kLetters[rng.below(kLetters.size() - 1)];
  return text;
}

IraceValue random_value(const IraceOption& option, Rng& rng) {
  switch (option.kind) {
    case IraceKind::Bool:
    case IraceKind::Flag:
    case IraceKind::Action:
      return rng.bernoulli(0.5);
    case IraceKind::Natural:
      return static_cast<std::int64_t>(rng.below(1ULL << rng.below(50)));
    case IraceKind::Real:
      return rng.uniform();
    case IraceKind::Choice: {
      const auto words = irace_words(option);
      return words[rng.below(words.size())];
    }
    case IraceKind::File:
    case IraceKind::Folder:
    case IraceKind::Program:
      return "/" + random_text(rng);
    case IraceKind::Text:
    case IraceKind::Texts:
    case IraceKind::Anything:
      break;
  }
  return random_text(rng);
}

IraceSetup random_setup(Rng& rng) {
  IraceSetup setup;
  setup.exec_dir = "/tune";
  setup.target_runner = "/tune/run";
  for (const irace::SetupField& field : irace::setup_fields()) {
    if (field.name == "repairConfiguration" || rng.bernoulli(0.5)) continue;
    field.set(setup, random_value(*find_irace_option(field.name), rng));
  }
  // What reading makes of them, whatever is written.
  if (setup.race.min_experiments) setup.race.max_experiments = 1'000'000'000'000'000;
  if (!setup.race.elitist) setup.race.postselection = false;
  return setup;
}

IraceScenarioFile parse(const std::string& text) {
  const ScenarioSurroundings nothing = {[](const std::filesystem::path&) -> Expected<std::string> {
                                          return bad_input("no files here");
                                        },
                                        [](const std::string&) { return std::nullopt; }};
  auto file = parse_irace_scenario(text, "/elsewhere/scenario.txt", nothing);
  EXPECT_TRUE(file) << to_string(file.error().front()) << "\n" << text;
  return file.value_or(IraceScenarioFile{});
}

TEST(ScenarioText, WhatIsPrintedReadsBackToTheSameOptions) {
  Rng rng(4);
  for (int round = 0; round < 400; ++round) {
    const IraceSetup setup = random_setup(rng);
    const IraceScenarioText printed = print_irace_scenario(setup, IraceVersion::V4);
    EXPECT_THAT(printed.remarks, IsEmpty());
    irace::SetupWork work;
    work.around.folder = "/elsewhere";
    work.settings = parse(printed.text).settings;
    irace::apply_options(work);
    for (const irace::SetupField& field : irace::setup_fields()) {
      if (field.name == "parameterFile" || field.name == "configurationsFile") continue;
      EXPECT_EQ(irace_value_text(field.get(work.setup)), irace_value_text(field.get(setup)))
          << field.name << "\n"
          << printed.text;
    }
  }
}

TEST(ScenarioText, SaysOnlyWhatDiffersFromTheDefaults) {
  IraceSetup setup;
  setup.log_file = "irace.Rdata";
  setup.race.max_experiments = 200;
  setup.race.test_type = TestType::TTestHolm;
  EXPECT_EQ(print_irace_scenario(setup, IraceVersion::V4, {.test = "test-list.txt"}).text,
            "logFile = \"irace.Rdata\"\nparameterFile = \"parameters.txt\"\n"
            "trainInstancesDir = \"\"\ntrainInstancesFile = \"instances-list.txt\"\n"
            "testInstancesFile = \"test-list.txt\"\nmaxExperiments = 200\n"
            "testType = \"t-test-holm\"\n");
}

TEST(ScenarioText, For35SaysWhatHasAnotherDefaultThereAndLeavesOutWhatIsNew) {
  IraceSetup setup;
  setup.race.max_experiments = 200;
  setup.race.block_size = 2;
  setup.target_runner_timeout = 30;
  const auto printed =
      print_irace_scenario(setup, IraceVersion::V3_5, {.forbidden = "forbidden.txt"});
  EXPECT_THAT(printed.text,
              AllOf(HasSubstr("softRestartThreshold = 1e-04\n"),
                    HasSubstr("budgetEstimation = 0.05\n"), HasSubstr("capping = 0\n"),
                    HasSubstr("digits = 4\n"), HasSubstr("forbiddenFile = \"forbidden.txt\"\n")));
  for (const char* name : {"blockSize", "targetRunnerTimeout", "postselection"}) {
    EXPECT_THAT(printed.text, Not(HasSubstr(name)));
    EXPECT_THAT(printed.remarks, Contains(HasSubstr(name)));
  }
}

TEST(ScenarioText, TemplatesBecomeLauncherArgumentsFor35) {
  IraceSetup setup;
  setup.target_runner_launcher = "/usr/bin/python3";
  setup.target_cmdline = "-O {targetRunner} " + setup.target_cmdline;
  const auto printed = print_irace_scenario(setup, IraceVersion::V3_5);
  EXPECT_THAT(printed.text,
              HasSubstr("targetRunnerLauncherArgs = \"-O {targetRunner} {targetRunnerArgs}\"\n"));
  setup.target_cmdline = "{seed} {instance} {targetRunnerArgs}";
  EXPECT_THAT(print_irace_scenario(setup, IraceVersion::V3_5).remarks,
              Contains(HasSubstr("targetCmdline")));
}

TEST(ScenarioText, ARepairProgramCannotBeToldToR) {
  IraceSetup setup;
  setup.repair_configuration = "/tune/repair";
  const auto printed = print_irace_scenario(setup, IraceVersion::V4);
  EXPECT_THAT(printed.text, Not(HasSubstr("repair")));
  EXPECT_THAT(printed.remarks, Contains(HasSubstr("repairConfiguration")));
}

TEST(IraceOptions, AreInWordsOfR) {
  IraceSetup setup;
  setup.race.elitist = false;
  setup.target_runner = "/a \"b\"";
  const auto options = irace_options(setup);
  EXPECT_THAT(options, Contains(testing::Pair("elitist", "FALSE")));
  EXPECT_THAT(options, Contains(testing::Pair("postselection", "TRUE")));
  EXPECT_THAT(options, Contains(testing::Pair("firstTest", "5")));
  EXPECT_THAT(options, Contains(testing::Pair("targetRunner", R"("/a \"b\"")")));
  // What is there only where it is used.
  EXPECT_THAT(options, Not(Contains(testing::Pair("boundMax", testing::_))));
  EXPECT_THAT(options, Not(Contains(testing::Pair("testType", testing::_))));
}

}  // namespace
}  // namespace swarmsmith
