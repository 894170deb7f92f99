#include "coordinator/campaign/irace_folder.h"

#include <string>
#include <vector>

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/campaign/tree_space.h"
#include "sim/control/machine_text.h"
#include "sim/control/tree.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// The same point of the space in words of the grammar: choices keep their index, what has one
/// value alone gets it.
Configuration in_grammar(const ParameterSpace& grammar, const ParameterSpace& named,
                         const Configuration& configuration) {
  Assignment values(grammar);
  for (const std::size_t i : grammar.hierarchy_order()) {
    if (!grammar.is_active(i, values)) continue;
    const auto same = named.index_of(grammar[i].name);
    values.set(i, same ? configuration[*same] : 0);
  }
  return values.configuration();
}

/// What irace puts on the target-runner's command line (irace facts, 18.1).
std::string command_line(const ParameterSpace& space, const Configuration& configuration) {
  std::string text;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    const Scalar value = space.scalar(i, configuration[i]);
    text += (text.empty() ? "" : " ") + space[i].switch_text;
    text += value.type == Scalar::Type::Text ? value.text : to_fixed_text(value.number);
  }
  return text;
}

/// Random points of the space that names modules: their command lines are their controllers.
template <class Space, class Parse, class Made>
void expect_the_same(const Space& named, const ParameterSpace& grammar, const Flavour& flavour,
                     const Parse& parse, const Made& made) {
  Rng rng(17);
  for (int i = 0; i < 300; ++i) {
    const Configuration configuration = random_configuration(named.parameters(), rng);
    const Configuration same = in_grammar(grammar, named.parameters(), configuration);
    ASSERT_TRUE(grammar.check(same)) << to_string(grammar.check(same).error());
    const std::string text = command_line(grammar, same);
    const auto controller = parse(text, flavour);
    ASSERT_TRUE(controller) << text << "\n" << to_string(controller.error());
    EXPECT_EQ(*controller, made(configuration)) << text;
  }
}

class IraceGrammar : public testing::TestWithParam<std::string> {};

TEST_P(IraceGrammar, HasCommandLinesThatAreTheMachinesOfTheNamedSpace) {
  const Method method =
      parsed(FileText{.method = "name = \"m\"\n" + GetParam(), .race = "max_experiments = 100000\n"}
                 .text())
          .methods[0];
  const Flavour& flavour = **find_flavour(method.flavour);
  const auto named = MachineSpace::make(method, flavour, 2);
  const auto grammar = MachineSpace::in_grammar(method, flavour, 2);
  ASSERT_TRUE(named && grammar);
  EXPECT_EQ(grammar->variable_count(), named->parameters().variable_count());
  expect_the_same(*named, *grammar, flavour, parse_machine,
                  [&](const Configuration& point) { return named->to_machine(point); });
}

INSTANTIATE_TEST_SUITE_P(
    All, IraceGrammar,
    testing::Values(
        "", "flavour = \"watermelon-argos3\"\n", "flavour = \"chocolate\"\n", "max_states = 1\n",
        "max_states = 2\n", "max_states = 3\nmax_transitions = 1\n",
        "max_states = 2\nmax_transitions = 1\nbehaviours = [\"stop\", \"exploration\"]\n"
        "conditions = [\"white_floor\", \"black_floor\"]\n"
        "parameters.white_floor.beta = { real = [0.5, 1] }\n"));

class IraceGrammarOfTrees : public testing::TestWithParam<std::string> {};

TEST_P(IraceGrammarOfTrees, HasCommandLinesThatAreTheTreesOfTheNamedSpace) {
  const Method method = parsed(FileText{.method = "name = \"m\"\nmethod = \"maple\"\n" + GetParam(),
                                        .race = "max_experiments = 100000\n"}
                                   .text())
                            .methods[0];
  const Flavour& flavour = **find_flavour(method.flavour);
  const auto named = TreeSpace::make(method, flavour, 2);
  const auto grammar = TreeSpace::in_grammar(method, flavour, 2);
  ASSERT_TRUE(named && grammar);
  expect_the_same(*named, *grammar, flavour, parse_tree,
                  [&](const Configuration& point) { return named->to_tree(point); });
}

INSTANTIATE_TEST_SUITE_P(All, IraceGrammarOfTrees,
                         testing::Values("", "flavour = \"chocolate\"\n", "max_subtrees = 1\n",
                                         "max_subtrees = 3\nbehaviours = [\"stop\", "
                                         "\"exploration\"]\nconditions = [\"white_floor\"]\n"));

std::string file_of(const std::vector<NamedText>& files, const std::string& name) {
  for (const NamedText& file : files) {
    if (file.name == name) return file.text;
  }
  ADD_FAILURE() << "no file " << name;
  return "";
}

std::vector<NamedText> folder_of(const Campaign& campaign, IraceVersion version) {
  const auto folder =
      irace_folder(campaign, design_rows(campaign).front(), version, "/opt/it's here/swarmsmith");
  EXPECT_TRUE(folder) << to_string(folder.error());
  return folder.value_or(IraceFolder{}).files;
}

TEST(IraceFolder, SaysForEachVersionWhereItsDigitsStand) {
  const Campaign campaign = parsed(FileText{}.text());
  const auto old = folder_of(campaign, IraceVersion::V3_5);
  EXPECT_THAT(file_of(old, "scenario.txt"), HasSubstr("digits = 2\n"));
  EXPECT_THAT(file_of(old, "parameters.txt"), Not(HasSubstr("[global]")));
  const auto late = folder_of(campaign, IraceVersion::V4);
  EXPECT_THAT(file_of(late, "scenario.txt"), Not(HasSubstr("digits")));
  EXPECT_THAT(file_of(late, "parameters.txt"), HasSubstr("[global]\ndigits = 2\n"));
}

TEST(IraceFolder, WritesModulesAsNumbersAndBoundsThatRCanAlwaysEvaluate) {
  const auto files = folder_of(parsed(FileText{}.text()), IraceVersion::V4);
  const std::string parameters = file_of(files, "parameters.txt");
  EXPECT_THAT(parameters, HasSubstr("\nS1 \"--s1 \" c (0, 1, 2, 3) | NumStates > 1\n"));
  EXPECT_THAT(parameters, HasSubstr("N1x0 \"--n1x0 \" i (0, \"max(0, NumStates - 2)\") | "
                                    "NumConnections1 > 0\n"));
  EXPECT_THAT(parameters, HasSubstr("P0x2 \"--p0x2 \" r (0, 1) | C0x2 %in% c(\"0\", \"1\", "));
}

TEST(IraceFolder, WritesTheOptionsThatAreNotIracesOwn) {
  const Campaign campaign =
      parsed(FileText{.race = "max_experiments = 100_000\nconfidence = 0.9\nmu = 7\n"
                              "elitist_limit = 0\nsample_instances = false\n"}
                 .text());
  const std::string scenario = file_of(folder_of(campaign, IraceVersion::V4), "scenario.txt");
  for (const char* line : {"maxExperiments = 100000\n", "confidence = 0.9\n", "mu = 7\n",
                           "elitistLimit = 0\n", "sampleInstances = 0\n"}) {
    EXPECT_THAT(scenario, HasSubstr(line));
  }
  EXPECT_THAT(scenario, Not(HasSubstr("firstTest")));
}

TEST(IraceFolder, QuotesTheProgramForTheShell) {
  const auto files = folder_of(parsed(FileText{}.text()), IraceVersion::V4);
  EXPECT_THAT(file_of(files, "target-runner"),
              HasSubstr("program='/opt/it'\\''s here/swarmsmith'\n"));
}

TEST(IraceFolder, SaysWhatThatIraceCannotBeTold) {
  Campaign campaign = parsed(FileText{}.text());
  const DesignRow design = design_rows(campaign).front();
  campaign.race.block_size = 2;
  const auto old = value_of(irace_folder(campaign, design, IraceVersion::V3_5, "/swarmsmith"));
  EXPECT_THAT(old.remarks, Contains(HasSubstr("`blockSize` does not exist")));
  const auto late = value_of(irace_folder(campaign, design, IraceVersion::V4, "/swarmsmith"));
  EXPECT_THAT(late.remarks, IsEmpty());
  EXPECT_THAT(file_of(late.files, "scenario.txt"), HasSubstr("blockSize = 2\n"));
  campaign.race.max_time = 100;
  EXPECT_EQ(why_not(irace_folder(campaign, design, IraceVersion::V4, "/swarmsmith")).where,
            "max_time");
}

TEST(IraceFolder, TestsAsManyElitesAsItsCampaign) {
  const std::string race =
      "max_experiments = 2000\ntest_nb_elites = 3\n"
      "test_iteration_elites = true\nrepair_configuration = \"/opt/repair\"\n";
  for (const FileText& file :
       {FileText{.race = race},
        FileText{.race = race,
        .rest = "[simulator]\nkind = \"command\"\ncommand = [\"/opt/run.sh\"]\n"}}) {
    const Campaign campaign = parsed(file.text());
    const auto folder = value_of(
        irace_folder(campaign, design_rows(campaign).front(), IraceVersion::V4, "/swarmsmith"));
    const std::string scenario = file_of(folder.files, "scenario.txt");
    EXPECT_THAT(scenario, HasSubstr("testNbElites = 3\n"));
    EXPECT_THAT(scenario, HasSubstr("testIterationElites = 1\n"));
    EXPECT_THAT(folder.remarks, ElementsAre(HasSubstr("`repairConfiguration` is left out")));
  }
}

TEST(IraceFolder, OfABaselineHasNothingToRace) {
  for (const char* baseline : {"random", "--nstates 1 --s0 1"}) {
    FileText file;
    file.method += "baseline = \"" + std::string(baseline) + "\"\n";
    const Campaign campaign = parsed(file.text());
    EXPECT_THAT(
        complaint_of(irace_folder(campaign, design_rows(campaign).front(), IraceVersion::V4, "/p")),
        HasSubstr("d1: it is of the baseline"));
  }
}

TEST(IraceFolder, OfATargetCallsItsPrograms) {
  const Campaign campaign =
      parsed(FileText{.mission = "name = \"tuning\"\ninstances.training = [\"a b\", \"c\"]\n",
                      .method = "name = \"all\"\nparameters_text = \"\"\"\n"
                                "a \\\"--a \\\" r (0, 10)\nb \\\"-b\\\" c (x, y)\n\"\"\"\n",
                      .race = "max_experiments = 400\n",
                      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"/opt/run.sh\"]\n"}
                 .text());
  const auto files = folder_of(campaign, IraceVersion::V4);
  EXPECT_THAT(file_of(files, "parameters.txt"), HasSubstr("b \"-b\" c (x, y)\n"));
  EXPECT_EQ(file_of(files, "instances.txt"), "a b\nc\n");
  EXPECT_THAT(file_of(files, "scenario.txt"), HasSubstr("targetRunner = \"/opt/run.sh\"\n"));
  for (const NamedText& file : files)
    EXPECT_NE(file.name, "target-runner");
}

TEST(IraceFolder, InstancesThatALineCannotHoldAreRefused) {
  for (const char* wrong : {"a#b", " lead"}) {
    for (const char* list : {"training", "test"}) {
      const std::string other = std::string(list) == "test" ? "instances.training = [\"a\"]\n" : "";
      const Campaign campaign = parsed(FileText{
          .mission =
              "name = \"tuning\"\n" + other + "instances." + list + " = [\"" + wrong + "\"]\n",
          .method = "name = \"all\"\nparameters_text = \"a \\\"--a \\\" r (0, 10)\"\n",
          .race = "max_experiments = 400\n",
          .rest = "[simulator]\nkind = \"command\"\ncommand = [\"/opt/run.sh\"]\n"}
                                           .text());
      EXPECT_THAT(complaint_of(irace_folder(campaign, design_rows(campaign).front(),
                                            IraceVersion::V4, "/p")),
                  HasSubstr("cannot hold the instance \"" + std::string(wrong) + "\""));
    }
  }
}

}  // namespace
}  // namespace swarmsmith
