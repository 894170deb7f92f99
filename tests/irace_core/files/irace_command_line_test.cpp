#include "irace_core/files/command_line.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Words = std::vector<std::string>;

IraceCommandLine read(const Words& words) {
  return value_of(read_irace_command_line(words, "/here"));
}

std::vector<std::string> errors_of(const Words& words) {
  return complaints_of(read_irace_command_line(words, "/here"));
}

TEST(IraceCommandLine, ReadsBothFormsOfLongOptionsAndShortOnes) {
  const auto line = read({"--max-experiments", "1000", "--seed=7", "-p", "a b.txt", "-e", "0"});
  EXPECT_EQ(line.action, IraceAction::Run);
  EXPECT_EQ(line.settings.number("maxExperiments"), 1000);
  EXPECT_EQ(line.settings.number("seed"), 7);
  EXPECT_EQ(line.settings.text("parameterFile"), "a b.txt");
  ASSERT_NE(line.settings.find("elitist"), nullptr);
  EXPECT_FALSE(line.settings.is_on("elitist"));
  EXPECT_EQ(line.settings.find("seed")->folder, "/here");
}

TEST(IraceCommandLine, TheLastOfEqualOptionsWins) {
  EXPECT_EQ(read({"--seed", "1", "--seed=2"}).settings.number("seed"), 2);
  EXPECT_EQ(read({"--seed", "1", "--seed="}).settings.find("seed"), nullptr);
}

TEST(IraceCommandLine, AnEmptyValueIsAnEmptyText) {
  const auto line = read({"--log-file=", "--train-instances-dir=", "--seed", "5"});
  EXPECT_EQ(line.settings.text("logFile"), "");
  EXPECT_EQ(line.settings.text("trainInstancesDir"), "");
  EXPECT_EQ(line.settings.number("seed"), 5);
}

TEST(IraceCommandLine, FlagsDoNotSwallowTheNextWord) {
  for (const char* flag : {"-c", "--check", "-q", "--quiet"}) {
    const auto line = read({flag, "--seed", "3", "--check"});
    EXPECT_EQ(line.settings.number("seed"), 3) << flag;
    EXPECT_EQ(line.action, IraceAction::Check);
  }
  EXPECT_TRUE(read({"-q", "--seed", "3"}).settings.is_on("quiet"));
}

TEST(IraceCommandLine, QuietMayHaveItsValue) {
  EXPECT_FALSE(read({"--quiet", "0"}).settings.is_on("quiet"));
  EXPECT_TRUE(read({"-q", "1", "--seed", "3"}).settings.is_on("quiet"));
  EXPECT_FALSE(read({"--quiet=0"}).settings.is_on("quiet"));
}

TEST(IraceCommandLine, SaysWhatToDo) {
  EXPECT_EQ(read({"-h", "-v"}).action, IraceAction::Help);
  EXPECT_EQ(read({"-v", "--check"}).action, IraceAction::Version);
  EXPECT_EQ(read({"-i"}).action, IraceAction::Init);
  const auto line = read({"--only-test", "best.txt", "--check"});
  EXPECT_EQ(line.action, IraceAction::OnlyTest);
  EXPECT_EQ(line.only_test, "/here/best.txt");
}

TEST(IraceCommandLine, OurOwnOptionsAreFoundByTheirSwitches) {
  const auto line = read({"--workers", "3", "--json", "--store", "x.db"});
  EXPECT_EQ(line.settings.number("--workers"), 3);
  EXPECT_TRUE(line.settings.is_on("--json"));
  EXPECT_FALSE(line.settings.is_on("--no-color"));
  EXPECT_EQ(line.settings.text("--store"), "x.db");
}

TEST(IraceCommandLine, EverythingWrongIsReportedTogether) {
  EXPECT_THAT(
      errors_of({"--max-experiment", "5", "6", "--seed", "x", "--elitist"}),
      ElementsAre(
          "--max-experiment: is not an option (did you mean \"--max-experiments\"?); --help "
          "lists all of them",
          HasSubstr("6: is not an option and belongs to none"),
          "--seed: must be a whole number, 0 or more, found \"x\"",
          "--elitist: needs a value after it"));
}

TEST(IraceCommandLine, NamesOfScenarioFilesLeadToSwitches) {
  EXPECT_THAT(errors_of({"--maxExperiments=5"}),
              ElementsAre(HasSubstr("the switch of `maxExperiments` is --max-experiments")));
  EXPECT_THAT(errors_of({"--repairConfiguration=x"}),
              ElementsAre(HasSubstr("can only be set in a scenario file")));
}

TEST(IraceCommandLine, WhatCannotBeUsedHereIsRefusedWithAWayOut) {
  EXPECT_THAT(errors_of({"--recovery-file", "irace.Rdata"}),
              ElementsAre(HasSubstr("the same command continues")));
  EXPECT_THAT(errors_of({"--mpi", "1"}), ElementsAre(HasSubstr("set `parallel`")));
  EXPECT_THAT(errors_of({"--hook-run", "x"}), ElementsAre(HasSubstr("write `targetRunner`")));
  EXPECT_THAT(errors_of({"--mpi", "0", "--recovery-file="}), IsEmpty());
}

TEST(IraceCommandLine, WhatMeansNothingOrIsOldIsAWarning) {
  EXPECT_THAT(read({"--load-balancing", "0"}).warnings,
              ElementsAre(HasSubstr("has no effect here")));
  EXPECT_THAT(read({"--load-balancing", "1"}).warnings, IsEmpty());
  EXPECT_THAT(read({"--digits", "2"}).warnings,
              ElementsAre(HasSubstr("write `digits = 2` under [global]")));
}

}  // namespace
}  // namespace swarmsmith
