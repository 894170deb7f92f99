#include "irace_core/files/scenario_file.h"

#include <map>
#include <string>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Files and environment of a test.
struct World {
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> variables;

  IraceScenarioFileOrErrors parse(const std::string& text) const {
    const auto look_up = [](const auto& map, const std::string& key) -> std::optional<std::string> {
      const auto found = map.find(key);
      return found == map.end() ? std::nullopt : std::optional(found->second);
    };
    const ScenarioSurroundings surroundings = {
        [this, look_up](const std::filesystem::path& file) -> Expected<std::string> {
          if (auto found = look_up(files, file.string())) return *found;
          return unexpected(ErrorKind::NotFound, "there is no such file");
        },
        [this, look_up](const std::string& name) { return look_up(variables, name); }};
    return parse_irace_scenario(text, "/tune/scenario.txt", surroundings);
  }

  /// The value as a scenario file writes it.
  std::string value(const std::string& text, const std::string& option) const {
    const auto file = parse(text);
    if (!file) return to_string(file.error().front());
    const IraceSetting* setting = file->settings.find(option);
    return setting == nullptr ? "unset" : irace_value_text(setting->value);
  }

  std::vector<std::string> errors(const std::string& text) const {
    return complaints_of(parse(text));
  }
};

TEST(ScenarioFile, KnowsTheFunctionsOfRealScenarios) {
  World world;
  world.files["/tune/lists/names.txt"] = "first\r\nsecond\nthird";
  const auto text = [&](const std::string& value) {
    return world.value("trainInstancesDir = " + value, "trainInstancesDir");
  };
  EXPECT_EQ(text("getwd()"), "\"/tune\"");
  EXPECT_EQ(text("dirname(getwd())"), "\"/\"");
  EXPECT_EQ(text("dirname(\"a/b/\")"), "\"a\"");
  EXPECT_EQ(text("dirname(\"a\")"), "\".\"");
  EXPECT_EQ(text("basename(\"/x/y.txt\")"), "\"y.txt\"");
  EXPECT_EQ(text("normalizePath(\"../data\", mustWork = FALSE)"), "\"/data\"");
  EXPECT_EQ(text("sub(\"tune$\", \"work\", getwd())"), "\"/work\"");
  EXPECT_EQ(text("gsub(\"([a-z])[0-9]+\", \"\\\\1-\", \"a1b22c\")"), "\"a-b-c\"");
  EXPECT_EQ(text("sub(\"run-([0-9]+)\", \"\\\\10\", \"run-7\")"), "\"70\"");
  EXPECT_EQ(text("gsub(\".\", \"$1\", \"a.b.c\", fixed = TRUE)"), "\"a$1b$1c\"");
  EXPECT_EQ(text("gsub(\"[[:space:]]\", \"$\", \"a b\")"), "\"a$b\"");
  EXPECT_EQ(text("sprintf(\"%s/%03d-%.1f%%\", \"x\", 7, 0.25)"), "\"x/007-0.2%\"");
  EXPECT_EQ(text("readLines(\"lists/names.txt\", n = 1)"), "\"first\"");
  EXPECT_EQ(text("r\"(a\\b)\""), "\"a\\\\b\"");
  EXPECT_EQ(text("R'--[x]-\"]--'"), "\"x]-\\\"\"");
  const auto texts = [&](const std::string& value) {
    return world.value("instances = " + value, "instances");
  };
  EXPECT_EQ(texts("paste0(\"i\", seq(1, 7, by = 3))"),
            world.value("instances = c(\"i1\", \"i4\", \"i7\")", "instances"));
  // R 4.2: seq counts back from `to` if there is no `from`.
  for (const auto& [call, numbers] :
       std::map<std::string, std::string>{{"seq(to = 10, length.out = 5)", "6, 7, 8, 9, 10"},
                                          {"seq(to = 10, by = 2, length.out = 3)", "6, 8, 10"},
                                          {"seq(to = 1, by = -2, length.out = 3)", "5, 3, 1"},
                                          {"seq(4, by = 2, length.out = 3)", "4, 6, 8"},
                                          {"seq(4, length.out = 3)", "4, 5, 6"},
                                          {"seq(1, 4, length.out = 4)", "1, 2, 3, 4"},
                                          {"seq(4, 1, length.out = 4)", "4, 3, 2, 1"},
                                          {"seq(length.out = 3)", "1, 2, 3"},
                                          {"seq(by = 2, length.out = 3)", "1, 3, 5"},
                                          {"seq(1, 5, length.out = 2.5)", "1, 3, 5"},
                                          {"seq(4, by = 2, length.out = 2.1)", "4, 6, 8"},
                                          {"seq(to = 10, length.out = 1.5)", "9, 10"},
                                          {"seq_len(2.5)", "1, 2"},
                                          {"seq(to = 3)", "1, 2, 3"},
                                          {"seq(3)", "1, 2, 3"},
                                          {"seq(from = 3)", "1, 2, 3"}}) {
    EXPECT_EQ(texts("paste0(\"i\", " + call + ")"),
              world.value("instances = paste0(\"i\", c(" + numbers + "))", "instances"))
        << call;
  }
  EXPECT_EQ(texts("sprintf(\"i%d\", seq_len(2))"),
            world.value("instances = c(\"i1\", \"i2\")", "instances"));
  EXPECT_EQ(texts("readLines(\"lists/names.txt\")"),
            world.value("instances = c(\"first\", \"second\", \"third\")", "instances"));
  EXPECT_EQ(world.value("100 * 5 -> maxExperiments", "maxExperiments"), "500");
  EXPECT_EQ(world.value(".n = 3; .n + 1 -> firstTest # right", "firstTest"), "4");
}

TEST(ScenarioFile, SaysWhatIsWrongWithACallOfAFunction) {
  const World world;
  const auto error = [&](const std::string& value) {
    const auto errors = world.errors("trainInstancesDir = " + value);
    return errors.empty() ? std::string("none") : errors.front();
  };
  EXPECT_THAT(error("sub(\"(\", \"\", \"a\")"),
              HasSubstr("the pattern \"(\" is not supported here"));
  EXPECT_THAT(error("sprintf(\"%s %s\", \"a\")"), HasSubstr("more places than values"));
  EXPECT_THAT(error("sprintf(\"%n\", 3)"), HasSubstr("sprintf knows"));
  EXPECT_THAT(error("sprintf(\"%d\", 0.5)"), HasSubstr("must be a whole number, found 0.5"));
  EXPECT_THAT(error("readLines(\"none.txt\")"), HasSubstr("readLines: there is no such file"));
  EXPECT_THAT(error("seq(1, 9, by = -1)"), HasSubstr("seq cannot come from 1 to 9 by -1"));
  EXPECT_THAT(error("seq(1, 9, by = 2, length.out = 5)"), HasSubstr("seq takes three of"));
  EXPECT_THAT(error("seq(1, 1e9)"), HasSubstr("too long a vector"));
  EXPECT_THAT(error("dirname(file = \"a\")"), HasSubstr("`dirname` has no argument `file` here"));
  EXPECT_THAT(error("r\"(a"), HasSubstr("not closed"));
  EXPECT_THAT(error("system(\"ls\")"), HasSubstr("programs in R are not read here"));
}

TEST(ScenarioFile, ReadsAssignmentsInEveryForm) {
  const World world;
  const std::string text =
      "# a comment\nmaxExperiments = 1e3 # another\nfirstTest <- 6; eachTest = 2L\n"
      "testType = 't-test'\nelitist = FALSE; sampleInstances = T\n\"seed\" = 42";
  EXPECT_EQ(world.value(text, "maxExperiments"), "1000");
  EXPECT_EQ(world.value(text, "firstTest"), "6");
  EXPECT_EQ(world.value(text, "eachTest"), "2");
  EXPECT_EQ(world.value(text, "testType"), "\"t-test\"");
  EXPECT_EQ(world.value(text, "elitist"), "0");
  EXPECT_EQ(world.value(text, "sampleInstances"), "1");
  EXPECT_EQ(world.value(text, "seed"), "42");
}

TEST(ScenarioFile, NullMissingAndEmptyValuesUnset) {
  const World world;
  for (const char* nothing : {"NULL", "NA", "\"\"", "c()", "list()"}) {
    EXPECT_EQ(world.value(std::string("seed = 3\nseed = ") + nothing, "seed"), "unset") << nothing;
  }
  EXPECT_EQ(world.value("logFile = \"\"", "logFile"), "\"\"");
  EXPECT_EQ(world.value("logFile = NULL", "logFile"), "unset");
}

TEST(ScenarioFile, ComputesValues) {
  World world;
  world.variables = {{"HOME", "/home/me"}};
  EXPECT_EQ(world.value(".n = 5\nmaxExperiments = 2 * .n ^ 2 * 10", "maxExperiments"), "500");
  EXPECT_EQ(world.value("firstTest = 6; mu = firstTest + 4", "mu"), "10");
  EXPECT_EQ(world.value("parameterFile = paste0(\"p\", 2L, \".txt\")", "parameterFile"),
            "\"p2.txt\"");
  EXPECT_EQ(world.value("execDir = file.path(Sys.getenv(\"HOME\"), \"x\", 'y')", "execDir"),
            "\"/home/me/x/y\"");
  EXPECT_EQ(world.value("execDir = Sys.getenv(\"NONE\", unset = \"z\")", "execDir"), "\"z\"");
  EXPECT_EQ(world.value("execDir = Sys.getenv(\"NONE\")", "execDir"), "\"\"");
  EXPECT_EQ(world.value("execDir = paste(\"a\", 1.50, TRUE, sep = \"-\")", "execDir"),
            "\"a-1.5-TRUE\"");
  EXPECT_EQ(world.value("execDir = paste(c(\"a\", \"b\"), 1:2, collapse = \"+\")", "execDir"),
            "\"a 1+b 2\"");
  EXPECT_EQ(world.value("confidence = max(0.5, 1 - 0.01)", "confidence"), "0.99");
  EXPECT_EQ(
      world.value(".fast = TRUE\nmaxExperiments = ifelse(.fast, 100, 1000)", "maxExperiments"),
      "100");
}

TEST(ScenarioFile, InstancesMayBeAVector) {
  const World world;
  EXPECT_EQ(world.value("instances = c(\"a b\", 'c')", "instances"), "c(\"a b\", \"c\")");
  EXPECT_EQ(world.value("instances = 1:3", "instances"), "c(\"1\", \"2\", \"3\")");
  EXPECT_EQ(world.value("instances = list(\"a\", 0.5)", "instances"), "c(\"a\", \"0.5\")");
  EXPECT_EQ(world.value("testInstances = \"one\"", "testInstances"), "c(\"one\")");
}

TEST(ScenarioFile, UnknownNamesAreErrorsWithSuggestions) {
  const World world;
  EXPECT_THAT(
      world.errors("\n  parametersFile = \"p.txt\""),
      ElementsAre("scenario.txt:2:3: there is no option `parametersFile` (did you mean "
                  "\"parameterFile\"?); names of your own variables must begin with a dot"));
}

TEST(ScenarioFile, EverythingWrongIsReportedTogether) {
  const World world;
  EXPECT_THAT(world.errors("firstTest = 2.5\nelitist = 3\nexecDir = 5\nseed = c(1, 2)\n"
                           "mu = .nothing\nfirstTst = 1\n"),
              ElementsAre("scenario.txt:1:13: `firstTest` must be a whole number, 0 or more, found "
                          "\"2.5\"",
                          HasSubstr("scenario.txt:2:11: `elitist` must be 0 or 1"),
                          "scenario.txt:3:11: `execDir` must be a text in quotes, found 5",
                          "scenario.txt:4:8: `seed` must be a single value, found 2",
                          HasSubstr("scenario.txt:5:6: nothing was assigned to `.nothing`"),
                          HasSubstr("did you mean \"firstTest\"")));
}

TEST(ScenarioFile, ErrorsThatFollowFromOthersAreNotReported) {
  const World world;
  EXPECT_THAT(world.errors(".a = foo(1)\nmu = .a + 1\nfirstTest = .a\n"),
              ElementsAre(HasSubstr("1:6: found the function `foo`")));
}

TEST(ScenarioFile, FunctionsOfRAreRefusedWithAWayOut) {
  const World world;
  const auto errors = world.errors("targetRunner = function(experiment, scenario) {\n  1\n}\n");
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0], HasSubstr("scenario.txt:1:16"));
  EXPECT_THAT(errors[0], HasSubstr("write a program"));
  EXPECT_THAT(world.errors("library(matlabr)\nmu = 5"),
              ElementsAre(HasSubstr("programs in R are not read")));
}

TEST(ScenarioFile, ValuesThatGoNowhereAreErrors) {
  const World world;
  EXPECT_THAT(world.errors("5 + 5"),
              ElementsAre(HasSubstr("this value is not assigned to an option")));
}

TEST(ScenarioFile, OptionsWithoutAMeaningHereAreRefusedOrIgnored) {
  const World world;
  EXPECT_THAT(world.errors("recoveryFile = \"irace.Rdata\""),
              ElementsAre(HasSubstr("the same command continues")));
  EXPECT_THAT(world.errors("mpi = 1"), ElementsAre(HasSubstr("set `parallel`")));
  EXPECT_THAT(world.errors("initConfigurations = .x"),
              ElementsAre(HasSubstr("configurationsFile")));
  EXPECT_THAT(world.errors("forbiddenExps = c(\"a == 1\")"),
              ElementsAre(HasSubstr("under [forbidden]")));
  EXPECT_THAT(world.errors("mpi = FALSE; recoveryFile = NULL; recoveryFile = \"\"\n"
                           "initConfigurations = NULL; targetRunnerParallel = NULL"),
              IsEmpty());
  const auto file = value_of(world.parse("targetRunnerData = list(1)\nloadBalancing = 0\nmpi = 0"));
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("scenario.txt:1:1: `targetRunnerData` has no effect here"),
                          HasSubstr("scenario.txt:2:1: `loadBalancing`")));
}

TEST(ScenarioFile, OptionsOfOlderVersionsAreReadWithAWarning) {
  const World world;
  const auto file =
      value_of(world.parse("digits = 2\nforbiddenFile = \"f.txt\"\npostselection = 0.1"));
  EXPECT_EQ(file.settings.number("digits"), 2);
  EXPECT_EQ(file.settings.text("forbiddenFile"), "f.txt");
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("under [global]"), HasSubstr("under [forbidden]"),
                          HasSubstr("a share of the budget in irace 3.5")));
  EXPECT_THAT(world.errors("instanceDir = \"a\""),
              ElementsAre(HasSubstr("write `trainInstancesDir`")));
}

TEST(ScenarioFile, IncludesOtherFiles) {
  World world;
  world.files = {{"/tune/common/base.txt", ".runs = 50\nfirstTest = 7\nparameterFile = \"p\""}};
  const auto file =
      value_of(world.parse("include.scenario(\"common/base.txt\")\nmaxExperiments = .runs * 10"));
  EXPECT_EQ(file.settings.number("maxExperiments"), 500);
  EXPECT_EQ(file.settings.number("firstTest"), 7);
  EXPECT_EQ(file.settings.find("firstTest")->where, "common/base.txt:2:1");
  // As in R, every path is relative to the first file.
  EXPECT_EQ(file.settings.find("parameterFile")->folder, "/tune");
}

TEST(ScenarioFile, AFilesOwnFolderIsThatOfWhatItReads) {
  World world;
  world.files = {{"/tune/deeper/base.txt", "include.scenario('more.txt')\nexecDir = getwd()"},
                 {"/tune/deeper/more.txt", "instances = readLines('list.txt')"},
                 {"/tune/deeper/list.txt", "of deeper"},
                 {"/tune/more.txt", "firstTest = 99"},
                 {"/tune/list.txt", "of the scenario"}};
  const auto file = value_of(
      world.parse("include.scenario('deeper/base.txt')\ntestInstances = readLines('list.txt')"));
  EXPECT_EQ(irace_value_text(file.settings.find("instances")->value), "c(\"of deeper\")");
  EXPECT_EQ(irace_value_text(file.settings.find("execDir")->value), "\"/tune/deeper\"");
  EXPECT_EQ(irace_value_text(file.settings.find("testInstances")->value), "c(\"of the scenario\")");
  EXPECT_EQ(file.settings.find("firstTest"), nullptr);
}

TEST(ScenarioFile, AnEmptyTextUnsetsAListToo) {
  const World world;
  for (const char* text : {"\"\"", "NULL", "NA", "c()"})
    EXPECT_EQ(world.value(std::string("testInstances = ") + text, "testInstances"),
              world.value("testInstances = NULL", "testInstances"));
  EXPECT_THAT(world.value("instances = c(\"a\", \"\")", "instances"), HasSubstr("\"a\""));
}

TEST(ScenarioFile, IncludesInACircleAreErrors) {
  World world;
  world.files = {{"/tune/a.txt", "include.scenario(\"b.txt\")"},
                 {"/tune/b.txt", "mu = 6\ninclude.scenario(\"./a.txt\")"}};
  EXPECT_THAT(world.errors("include.scenario('a.txt')"),
              ElementsAre(HasSubstr("b.txt:2:1: /tune/a.txt includes itself")));
  EXPECT_THAT(
      world.errors("include.scenario('none.txt')"),
      ElementsAre("scenario.txt:1:1: cannot include /tune/none.txt: there is no such file"));
  EXPECT_THAT(world.errors("include.scenario()"), ElementsAre(HasSubstr("the name of one file")));
}

TEST(ScenarioFile, EndlessTextsAndVectorsAreRefused) {
  const World world;
  std::string text = ".a = \"0123456789\"\n";
  for (int i = 0; i < 40; ++i)
    text += ".a = paste0(.a, .a)\n";
  EXPECT_THAT(world.errors(text).front(), HasSubstr("too long a text"));
  text = ".a = 1:1000\n";
  for (int i = 0; i < 40; ++i)
    text += ".a = c(.a, .a)\n";
  EXPECT_THAT(world.errors(text).front(), HasSubstr("too long a vector"));
}

}  // namespace
}  // namespace swarmsmith
