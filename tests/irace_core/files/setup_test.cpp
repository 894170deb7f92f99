#include "irace_core/files/setup.h"

#include <cstdlib>
#include <fstream>

#include "irace_core/files/templates.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// A folder with a small tuning task, which tests change and then read.
class IraceSetupFiles : public testing::Test {
 protected:
  IraceSetupFiles() {
    write("parameters.txt", "a \"--a \" r (0, 1)\nb \"--b \" c (x, y)\n");
    write("list.txt", "one\ntwo three\n");
    write_program("target-runner");
    write("scenario.txt", "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\n");
  }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  void write_program(const std::string& name) const {
    write(name, "#!/bin/sh\necho 1\n");
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  IraceSetupOrErrors read_in(const fs::path& folder, const std::vector<std::string>& words) const {
    const auto line = read_irace_command_line(words, folder);
    EXPECT_TRUE(line) << to_string(line.error().front());
    return read_irace_setup(*line, {folder, path("bin") + ":relative"});
  }
  IraceSetupOrErrors read(const std::vector<std::string>& words = {}) const {
    return read_in(folder_.path(), words);
  }

  IraceSetup setup(const std::vector<std::string>& words = {}) const {
    return value_of(read(words));
  }
  std::vector<std::string> errors(const std::vector<std::string>& words = {}) const {
    return complaints_of(read(words));
  }

  TemporaryFolder folder_;
};

TEST_F(IraceSetupFiles, ABudgetThatIsTooSmallNamesItsOptionAndWhatWorks) {
  EXPECT_THAT(errors({"--max-experiments", "20"}),
              ElementsAre("--max-experiments: a budget of 20 experiments is too small: with these "
                          "settings it must be at least 96"));
  write("scenario.txt", "trainInstancesFile = \"list.txt\"\nmaxExperiments = 95\n");
  EXPECT_THAT(errors(), ElementsAre(HasSubstr("scenario.txt:2:1: ")));
  EXPECT_THAT(errors({"--max-experiments", "96"}), IsEmpty());
}

TEST_F(IraceSetupFiles, ALogFileIsNoFolder) {
  fs::create_directories(folder_ / "logs");
  EXPECT_THAT(errors({"--log-file", "logs"}), ElementsAre(HasSubstr("is a folder; name a file")));
  EXPECT_THAT(errors({"--log-file", "logs/x.Rdata"}), IsEmpty());
}

TEST_F(IraceSetupFiles, AnyLevelOfDebuggingIsOne) {
  EXPECT_EQ(setup({"--debug-level", "5"}).debug_level, 5);
}

TEST_F(IraceSetupFiles, AScenarioAndWhatItNamesIsRead) {
  write("scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\nfirstTest = 2\nseed = 9\n"
        "testInstances = c(\"t1\", \"t2\")\ncappingType = \"worst\"\nparallel = 4\n"
        "configurationsFile = \"first.txt\"\ntestType = \"t-test\"\n");
  write("first.txt", "a b\n0.5 y\n");
  const IraceSetup read = setup();
  EXPECT_EQ(read.race.max_experiments, 500);
  EXPECT_EQ(read.race.first_test, 2);
  EXPECT_EQ(read.race.n_instances, 2);
  EXPECT_EQ(read.race.seed, 9U);
  EXPECT_EQ(read.seed, 9U);
  EXPECT_EQ(read.race.test_type, TestType::TTest);
  EXPECT_EQ(read.race.capping_type, CappingType::Worst);
  EXPECT_EQ(read.parallel, 4);
  EXPECT_EQ(read.race.parallel, 4);
  EXPECT_THAT(read.training, ElementsAre("one", "two three"));
  EXPECT_THAT(read.test, ElementsAre("t1", "t2"));
  EXPECT_EQ(read.space.size(), 2U);
  EXPECT_EQ(read.parameter_text, "a \"--a \" r (0, 1)\nb \"--b \" c (x, y)\n");
  ASSERT_EQ(read.initial.size(), 1U);
  EXPECT_EQ(read.initial[0][0], 0.5);
  EXPECT_EQ(read.target_runner, path("target-runner"));
  EXPECT_EQ(read.exec_dir, folder_.path());
  EXPECT_EQ(read.log_file, path("irace.Rdata"));
  EXPECT_EQ(read.store, path("irace.db"));
  EXPECT_EQ(read.scenario_file, path("scenario.txt"));
}

TEST_F(IraceSetupFiles, ParametersOfOtherToolsBecomeIracesAndTheirDefaultsComeFirst) {
  write("space.pcs", "a [0, 1] [0.25]\nb {x, y}[x]\n");
  const IraceSetup read = setup({"-p", "space.pcs"});
  EXPECT_EQ(read.parameter_text,
            "a \"-a \" r (0, 1)\nb \"-b \" c (x, y)\n\n[global]\ndigits = 4\n");
  ASSERT_EQ(read.initial.size(), 1U);
  EXPECT_EQ(read.initial[0][0], 0.25);
  EXPECT_EQ(read.configurations_text, "a b\n0.25 x\n");
  EXPECT_EQ(setup({"-p", "space.pcs", "--aclib", "1"}).space[0].switch_text, "a");

  write("first.txt", "a b\n0.5 y\n");
  const IraceSetup both = setup({"-p", "space.pcs", "--configurations-file", "first.txt"});
  EXPECT_EQ(both.initial.size(), 2U);
  EXPECT_EQ(both.configurations_text, "a b\n0.25 x\n0.5 y\n");

  write("space.json", R"({"hyperparameters": [{"name": "a", "type": "constant", "value": 1},
    {"name": "b", "type": "uniform_float", "lower": 0, "upper": 1, "default": 0.5}]})");
  EXPECT_EQ(setup({"-p", "space.json"}).space[1].switch_text, "--b ");
  write("none.txt", "");
  EXPECT_THAT(errors({"-p", "space.json", "--forbidden-file", "none.txt"}),
              Contains(HasSubstr("not in irace's format")));
}

TEST_F(IraceSetupFiles, AScenarioThatWasNotNamedIsReadWithAWarning) {
  EXPECT_THAT(setup().warnings, ElementsAre(HasSubstr("because it exists")));
  EXPECT_THAT(setup({"--scenario", "scenario.txt"}).warnings, IsEmpty());
}

TEST_F(IraceSetupFiles, WithoutAScenarioTheCommandLineSaysAll) {
  fs::remove(folder_ / "scenario.txt");
  const IraceSetup read = setup({"--max-experiments", "300", "--train-instances-file", "list.txt"});
  EXPECT_TRUE(read.scenario_file.empty());
  EXPECT_EQ(read.race.max_experiments, 300);
  EXPECT_EQ(read.seed, std::nullopt);
  EXPECT_EQ(read.parallel, std::nullopt);
  EXPECT_THAT(errors(), Contains(HasSubstr("no budget given")));
}

TEST_F(IraceSetupFiles, AnEmptyScenarioNameMeansNone) {
  EXPECT_THAT(errors({"--scenario="}), Contains(HasSubstr("no budget given")));
}

TEST_F(IraceSetupFiles, TheCommandLineWinsOverTheFile) {
  write("scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\nseed = 1\nfirstTest = 2\n");
  const IraceSetup read = setup({"--seed", "2", "--first-test=", "--max-experiments=600"});
  EXPECT_EQ(read.seed, 2U);
  EXPECT_EQ(read.race.first_test, 5);
  EXPECT_EQ(read.race.max_experiments, 600);
}

TEST_F(IraceSetupFiles, PathsBeginWhereTheyAreWritten) {
  write("sub/scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"../list.txt\"\nexecDir = \"runs\"\n"
        "targetRunner = \"./run\"\nlogFile = \"log/mine.Rdata\"\nparameterFile = \"p.txt\"\n");
  write("sub/p.txt", "z \"\" i (1, 9)\n");
  write_program("sub/run");
  fs::create_directories(folder_ / "sub/runs/log");
  const IraceSetup read = setup({"-s", "sub/scenario.txt", "-p", "parameters.txt"});
  EXPECT_EQ(read.exec_dir, path("sub/runs"));
  EXPECT_EQ(read.target_runner, path("sub/run"));
  EXPECT_EQ(read.log_file, path("sub/runs/log/mine.Rdata"));
  EXPECT_EQ(read.store, path("sub/runs/log/mine.db"));
  EXPECT_EQ(read.parameter_file, path("parameters.txt"));
  EXPECT_EQ(setup({"-s", "sub/scenario.txt"}).space[0].name, "z");
}

TEST(IracePaths, ATildeIsTheHomeFolderAtTheBeginningOnly) {
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') GTEST_SKIP() << "there is no home folder";
  const fs::path folder = fs::path(home).lexically_normal();
  EXPECT_EQ(absolute_path("~/a/../b", "/c"), folder / "b");
  EXPECT_EQ(absolute_path("~", "/c"), absolute_path(home, "/"));
  EXPECT_EQ(absolute_path("a/~/b", "/c"), "/c/a/~/b");
  EXPECT_EQ(absolute_path("~a/b", "/c"), "/c/~a/b");
  EXPECT_EQ(absolute_path("./~/b", "/c"), "/c/~/b");
}

TEST_F(IraceSetupFiles, DefaultsThatLieBesideTheScenarioAreFoundThere) {
  fs::create_directories(folder_ / "elsewhere");
  const auto read = value_of(read_in(folder_ / "elsewhere", {"-s", "../scenario.txt"}));
  EXPECT_EQ(read.target_runner, path("target-runner"));
  EXPECT_EQ(read.exec_dir, path("elsewhere"));
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("`parameterFile` is not set"),
                                         HasSubstr("`targetRunner` is not set")));
}

TEST_F(IraceSetupFiles, ProgramsWithoutASlashAreLookedForInThePath) {
  write_program("bin/solve");
  const std::vector<std::string> words = {"--target-runner", "solve"};
  EXPECT_EQ(setup(words).target_runner, path("bin/solve"));
  write_program("solve");
  EXPECT_EQ(setup(words).target_runner, path("bin/solve"));
  EXPECT_THAT(setup(words).warnings, Contains(HasSubstr("write `./solve`")));
  EXPECT_EQ(setup({"--target-runner", "./solve"}).target_runner, path("solve"));
  EXPECT_EQ(setup({"--target-runner", "target-runner"}).target_runner, path("target-runner"));
}

TEST_F(IraceSetupFiles, TheStoreMayBeNamedOrLeftOut) {
  EXPECT_EQ(setup({"--store", "s.db", "--log-file="}).store, path("s.db"));
  EXPECT_TRUE(setup({"--log-file="}).store.empty());
  EXPECT_EQ(setup({"--log-file=x.sqlite"}).store, path("x.sqlite"));
  EXPECT_THAT(errors({"--log-file=none/x.Rdata"}),
              ElementsAre(AllOf(HasSubstr("--log-file: there is no folder"), HasSubstr("none"))));
}

TEST_F(IraceSetupFiles, InstancesOfAFolderAndWithAFolder) {
  write("data/b", "");
  write("data/a", "");
  EXPECT_THAT(setup({"--train-instances-dir", "data", "--train-instances-file="}).training,
              ElementsAre(path("data/a"), path("data/b")));
  EXPECT_THAT(setup({"--train-instances-dir", "data"}).training,
              ElementsAre(path("data/one"), path("data/two three")));
}

TEST_F(IraceSetupFiles, TheFolderOfOlderVersionsIsUsedWithAWarning) {
  write("Instances/i1", "");
  write("scenario.txt", "maxExperiments = 500\n");
  const IraceSetup read = setup({"-s", "scenario.txt"});
  EXPECT_THAT(read.training, ElementsAre(path("Instances/i1")));
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("as irace 3.5 does")));
  fs::remove_all(folder_ / "Instances");
  EXPECT_THAT(errors(), ElementsAre(HasSubstr("no training instances given")));
}

TEST_F(IraceSetupFiles, AListThatNeedsTheFolderOfOlderVersionsIsAWarning) {
  write("Instances/one", "");
  EXPECT_THAT(setup({"-s", "scenario.txt"}).warnings,
              ElementsAre(HasSubstr("write trainInstancesDir = \"./Instances\"")));
}

TEST_F(IraceSetupFiles, FilesOfOlderVersionsAreWorkedIn) {
  write("scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\ndigits = 2\n"
        "forbiddenFile = \"forbidden.txt\"\n");
  write("forbidden.txt", "(a < 0.5) & (b == \"y\")\n");
  const IraceSetup read = setup();
  EXPECT_EQ(read.space.digits(), 2);
  EXPECT_EQ(read.space.forbidden().size(), 1U);
  EXPECT_THAT(read.parameter_text, AllOf(HasSubstr("[forbidden]"), HasSubstr("digits = 2")));
  EXPECT_THAT(read.warnings, Contains(HasSubstr("under [forbidden]")));
}

TEST_F(IraceSetupFiles, ScenariosOfAutoModeAreReadWithTheirDependencyFile) {
  write("scenario.txt",
        "parameterFile = \"./automode.txt\"\ndependencyFile = \"./dependencies.txt\"\n"
        "execDir = \"./run\"\ntrainInstancesDir = \"./missions\"\nmaxExperiments = 200\n"
        "nbIterations = 2\ndigits = 2\n");
  write("automode.txt",
        "NumStates \"--nstates \" i (1, 4)\n"
        "N0x0 \"--n0x0 \" i (0, 3) | as.numeric(NumStates)>1\n");
  write("dependencies.txt", "N0x0 (|NumStates-2)\n");
  write("missions/aggregation.argos", "");
  fs::create_directories(folder_ / "run");
  const IraceSetup read = setup();
  EXPECT_EQ(read.race.nb_iterations, 2);
  EXPECT_THAT(read.training, ElementsAre(path("missions/aggregation.argos")));
  EXPECT_EQ(read.space.constant_interval(1), nullptr);  // it depends on NumStates
  EXPECT_THAT(read.parameter_text, HasSubstr("NumStates - 2"));
  EXPECT_THAT(read.warnings, Contains(HasSubstr("`dependencyFile` is read")));
}

TEST_F(IraceSetupFiles, EverythingWrongIsReportedTogether) {
  write("scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"none.txt\"\nexecDir = \"nowhere\"\n"
        "targetRunner = \"./missing\"\ntargetCmdline = \"{seed} {targetRunnerArgs}\"\n"
        "firstTest = 5\neachTest = 2\nbatchmode = \"slurm\"\n");
  write("parameters.txt", "a \"--a \" r (1, 0)\n");
  EXPECT_THAT(errors(),
              ElementsAre(HasSubstr("scenario.txt:2:1: `trainInstancesFile`: " + path("none.txt")),
                          HasSubstr("parameters.txt:1:"),
                          HasSubstr("scenario.txt:3:1: `execDir`: there is no such folder"),
                          HasSubstr("scenario.txt:4:1: `targetRunner`: there is no such program"),
                          HasSubstr("scenario.txt:8:1: `batchmode` needs `targetEvaluator`"),
                          HasSubstr("scenario.txt:5:1: `targetCmdline` must contain {instance}"),
                          "scenario.txt:6:1: `firstTest` must be a multiple of eachTest, which "
                          "is 2, and is 5"));
}

TEST_F(IraceSetupFiles, AMessageNamesAnOptionWhoseNameIsPartOfAnotherWord) {
  write("scenario.txt",
        "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\nmu = 11\nblockSize = 2\n");
  EXPECT_THAT(errors(), ElementsAre(StartsWith("scenario.txt:3:1: `mu` must be a multiple of ")));
  // irace raises it to firstTest.
  write("scenario.txt", "maxExperiments = 500\ntrainInstancesFile = \"list.txt\"\nmu = 0\n");
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(IraceSetupFiles, AProgramMustBeExecutable) {
  write("plain", "echo 1\n");
  EXPECT_THAT(errors({"--target-runner", "plain"}),
              ElementsAre(AllOf(HasSubstr("--target-runner: "), HasSubstr("chmod +x"))));
  // What a launcher starts need not be.
  write_program("bin/launch");
  const IraceSetup read = setup({"--target-runner", "plain", "--target-runner-launcher", "launch"});
  EXPECT_EQ(read.target_runner_launcher, path("bin/launch"));
}

TEST_F(IraceSetupFiles, LauncherArgumentsOfOlderVersionsBecomeATemplate) {
  write_program("bin/launch");
  const IraceSetup read = setup({"--target-runner-launcher", "launch", "--target-runner-args",
                                 "-x {targetRunner} {targetRunnerArgs}"});
  EXPECT_EQ(read.target_cmdline,
            "-x {targetRunner} {configurationID} {instanceID} {seed} {instance} {bound} "
            "{targetRunnerArgs}");
}

TEST_F(IraceSetupFiles, ABudgetIsRunsOrTime) {
  EXPECT_THAT(errors({"--max-time", "60"}),
              ElementsAre(HasSubstr("--max-time: is given together with `maxExperiments`")));
  EXPECT_EQ(setup({"--max-time", "60", "--max-experiments", "0"}).race.max_time, 60);
  EXPECT_EQ(setup({"--min-experiments", "900"}).race.max_experiments, 900);
  // The message names the option that was set (minExperiments raises maxExperiments, 3.4).
  EXPECT_THAT(
      errors({"--max-time", "60", "--max-experiments", "0", "--min-experiments", "200"}),
      ElementsAre(AllOf(HasSubstr("--max-time: is given together with `minExperiments`"),
                        HasSubstr("leave one of them out"), Not(HasSubstr("maxExperiments")))));
  EXPECT_THAT(errors({"--max-time", "60", "--min-experiments", "200"}),
              ElementsAre(HasSubstr("--max-time: is given together with `maxExperiments`")));
}

TEST_F(IraceSetupFiles, TestingAloneNeedsTestInstancesOnly) {
  write("scenario.txt", "");
  EXPECT_THAT(errors({"--only-test", "best.txt"}),
              ElementsAre(HasSubstr("--only-test needs test instances")));
  EXPECT_THAT(setup({"--only-test", "best.txt", "--test-instances-file", "list.txt"}).test,
              ElementsAre("one", "two three"));
}

TEST_F(IraceSetupFiles, PostselectionEndsWithoutElites) {
  EXPECT_TRUE(setup().race.postselection);
  EXPECT_FALSE(setup({"--elitist", "0"}).race.postselection);
  EXPECT_FALSE(setup({"--postselection", "0"}).race.postselection);
}

TEST_F(IraceSetupFiles, ErrorsOfTheScenarioComeAlone) {
  write("scenario.txt", "maxExperiments = \"x\"\nparametersFile = \"y\"\n");
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_THAT(errors({"-s", "none.txt"}),
              ElementsAre(path("none.txt") + ": there is no such file"));
}

TEST(IraceTemplates, AreReadWithoutAnError) {
  const TemporaryFolder folder;
  for (const IraceTemplate& file : irace_templates()) {
    std::ofstream(folder / file.name) << file.text;
    if (file.is_program) fs::permissions(folder / file.name, fs::perms::owner_all);
  }
  const std::vector<std::string> words = {"--scenario", "scenario.txt"};
  const auto setup = value_of(
      read_irace_setup(*read_irace_command_line(words, folder.path()), {folder.path(), ""}));
  EXPECT_EQ(setup.space.size(), 4U);
  EXPECT_EQ(setup.space.forbidden().size(), 1U);
  EXPECT_EQ(setup.initial.size(), 2U);
  EXPECT_EQ(setup.training.size(), 5U);
  EXPECT_THAT(setup.warnings, IsEmpty());
}

TEST(IraceTemplates, EveryCommentedOptionOfTheScenarioCanBeSwitchedOn) {
  const TemporaryFolder folder;
  std::string scenario = irace_templates().front().text;
  std::string all;
  for (std::size_t begin = 0; begin < scenario.size();) {
    const std::size_t end = scenario.find('\n', begin);
    std::string line = scenario.substr(begin, end - begin);
    const std::size_t equals = line.find(" = ");
    const bool is_option =
        line.starts_with("# ") && equals != std::string::npos && line.find(' ', 2) == equals;
    if (is_option) all += line.substr(2) + "\n";
    begin = end + 1;
  }
  EXPECT_THAT(all, HasSubstr("confidence = 0.95"));
  const auto line = read_irace_command_line({}, folder.path());
  std::ofstream(folder / "scenario.txt") << scenario << all;
  const auto setup = read_irace_setup(*line, {folder.path(), ""});
  ASSERT_FALSE(setup);  // the other files are not there
  for (const Error& error : setup.error())
    EXPECT_THAT(error.message, HasSubstr("there is no such")) << to_string(error);
}

}  // namespace
}  // namespace swarmsmith
