#include "programs/command_line.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

RunnerCall some_call() {
  return {.configuration = 12,
          .instance_id = "3",
          .seed = 734718556,
          .instance = "inst/a.tsp",
          .bound = 0,
          .switches = "--as --alpha 2.92 --ants 80"};
}

/// The example of irace facts, 18.1: two blanks where the empty bound was.
TEST(CommandLine, HasTheSpacingOfIrace) {
  EXPECT_EQ(arguments_of(Target{}, some_call()),
            "12 3 734718556 inst/a.tsp  --as --alpha 2.92 --ants 80");
}

TEST(CommandLine, HasTheBoundWhereThereIsOne) {
  RunnerCall call = some_call();
  call.bound = 12.5;
  EXPECT_EQ(arguments_of(Target{}, call),
            "12 3 734718556 inst/a.tsp 12.5 --as --alpha 2.92 --ants 80");
}

TEST(CommandLine, FollowsTheTemplate) {
  Target target;
  target.runner = "/r";
  target.command_line =
      "-s {seed} {unknown} {instance}{instanceID} <{targetRunnerArgs}> {targetRunner}";
  EXPECT_EQ(arguments_of(target, some_call()),
            "-s 734718556 {unknown} inst/a.tsp3 <--as --alpha 2.92 --ants 80> '/r'");
}

TEST(CommandLine, DoesNotLookAtWhatComesIn) {
  RunnerCall call = some_call();
  call.instance = "{seed}";
  call.switches = "{instance} {";
  EXPECT_EQ(arguments_of(Target{}, call), "12 3 734718556 {seed}  {instance} {");
}

TEST(CommandLine, NamesTheRunnerForALauncher) {
  Target target;
  target.runner = "/opt/my runner.R";
  target.launcher = "/usr/bin/Rscript";
  EXPECT_EQ(arguments_of(target, some_call()).substr(0, 22), "'/opt/my runner.R' 12 ");
  target.command_line = "--vanilla {targetRunner} {seed} {instance} {targetRunnerArgs}";
  EXPECT_EQ(arguments_of(target, some_call()).substr(0, 28), "--vanilla '/opt/my runner.R'");
}

TEST(CommandLine, SpeaksToAclib) {
  Target target;
  target.aclib = true;
  EXPECT_EQ(arguments_of(target, some_call()),
            "--instance inst/a.tsp --seed 734718556 --config --as --alpha 2.92 --ants 80");
  RunnerCall call = some_call();
  call.bound = 10;
  EXPECT_EQ(arguments_of(target, call).substr(0, 56),
            "--cutoff 10 --instance inst/a.tsp --seed 734718556 --con");
}

TEST(CommandLine, TellsAnEvaluatorWhoIsAlive) {
  EXPECT_EQ(arguments_of(EvaluatorCall{.configuration = 4,
                                       .instance_id = "2t",
                                       .seed = 99,
                                       .instance = "a b",
                                       .alive = {1, 4, 17}}),
            "4 2t 99 a b 3 1 4 17");
}

TEST(CommandLine, MustHaveItsParts) {
  EXPECT_TRUE(faults_of_command_line(Target{}.command_line, true).empty());
  EXPECT_EQ(faults_of_command_line("{configurationID}", true).size(), 4U);
  EXPECT_EQ(faults_of_command_line("{seed} {instance} {targetRunnerArgs}", false).size(), 0U);
  const auto faults = faults_of_command_line("{seed} {instance} {targetRunnerArgs}", true);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("{bound}"), std::string::npos);
}

TEST(CommandLine, WritesNumbersWithoutExponents) {
  EXPECT_EQ(plain_number(100000), "100000");
  EXPECT_EQ(plain_number(0.1), "0.1");
  EXPECT_EQ(plain_number(0.00001), "0.00001");
  EXPECT_EQ(plain_number(0.1 + 0.2), "0.3");
  EXPECT_EQ(plain_number(1e15), "1000000000000000");
  EXPECT_EQ(plain_number(12.5), "12.5");
  EXPECT_EQ(plain_number(-3), "-3");
}

}  // namespace
}  // namespace swarmsmith
