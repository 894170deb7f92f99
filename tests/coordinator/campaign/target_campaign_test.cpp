#include <fstream>

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/irace_campaign.h"
#include "coordinator/campaign/method_space.h"
#include "coordinator/campaign/programs.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

const std::string kSimulator = "[simulator]\nkind = \"command\"\ncommand = [\"./run.sh\"]\n";

std::string with_parameters(const std::string& race = "max_experiments = 400\n",
                            const std::string& rest = kSimulator) {
  return FileText{
      .mission = "name = \"tuning\"\ninstances.training = [\"a b\", \"c\"]\n",
      .method = std::string("name = \"all\"\nparameters_text = '''\n") +
                "a \"--a \" r (0, 10)\nb \"-b\" c (x, y)\nd \"\" i (1, 5) | b == \"x\"\n"
                "e \"--e=\" r (0.1, 1)\n'''\n",
      .race = race,
      .rest = rest}
      .text();
}

/// Reading what was written must give the same campaign, which needs no other file.
void expect_kept(const Campaign& campaign) {
  const auto again = parse_campaign(normalised_text(campaign), "elsewhere/y.toml");
  ASSERT_TRUE(again) << to_string(again.error().front()) << "\n" << normalised_text(campaign);
  EXPECT_EQ(normalised_text(*again), normalised_text(campaign));
  EXPECT_EQ(campaign_digest(*again), campaign_digest(campaign));
  EXPECT_EQ(again->target, campaign.target);
  EXPECT_EQ(again->missions, campaign.missions);
  EXPECT_EQ(again->methods, campaign.methods);
}

TEST(TargetCampaign, KeepsInstancesParametersAndPrograms) {
  const Campaign campaign = parsed(with_parameters());
  ASSERT_TRUE(campaign.target);
  EXPECT_THAT(campaign.target->runner, EndsWith("/in/run.sh"));
  EXPECT_EQ(campaign.missions[0].instances.training, (std::vector<std::string>{"a b", "c"}));
  EXPECT_EQ(campaign.missions[0].test_count, 0);
  EXPECT_TRUE(campaign.stop_on_failure);
  const auto space = value_of(MethodSpace::make(campaign.methods[0], 2));
  EXPECT_EQ(space.parameters().size(), 4U);
  EXPECT_EQ(race_on(campaign, campaign.missions[0]).n_instances, 2);
  EXPECT_TRUE(race_on(campaign, campaign.missions[0]).one_task_at_a_time);
  expect_kept(campaign);
}

TEST(TargetCampaign, KeepsAnAblation) {
  const auto text = [](const std::string& race) {
    return FileText{.mission = "name = \"tuning\"\n",
                    .method =
                        "name = \"all\"\nparameters_text = \"a \\\"--a \\\" r (0, 10)\"\n"
                        "configurations_text = \"a\\n1\\n2\\n\"\n",
                    .race = race,
                    .rest = kSimulator}
        .text();
  };
  const std::string race = "max_experiments = 400\nablation = \"racing\"\nablation_pairs = 7\n";
  const Campaign campaign = parsed(text(race));
  EXPECT_EQ(campaign.race.ablation, AblationType::Racing);
  EXPECT_EQ(campaign.race.ablation_pairs, 7);
  EXPECT_EQ(design_rows(campaign).front().seed, static_cast<std::int64_t>(campaign.seed));
  expect_kept(campaign);
  EXPECT_THAT(complaints(text("max_experiments = 13\nablation = \"full\"\nablation_pairs = 7\n")),
              ElementsAre(HasSubstr("at least 14")));
  EXPECT_THAT(complaints(with_parameters("max_experiments = 400\nablation = \"full\"\n")),
              ElementsAre(HasSubstr("two given configurations")));
  EXPECT_THAT(complaints(text("max_experiments = 400\nablation_pairs = 7\n")),
              ElementsAre(HasSubstr("is for campaigns with `ablation`")));
  EXPECT_THAT(complaints(FileText{.race = race}.text()),
              Contains(HasSubstr("`ablation` needs [simulator]")));
}

/// Of a method with parameters that every search takes.
std::string searched_by(const std::string& search) {
  return FileText{
      .mission = "name = \"tuning\"\n",
      .method = "name = \"all\"\nparameters_text = \"a \\\"--a \\\" r (0, 10)\"\n" + search,
      .race = "max_experiments = 4000\n",
      .rest = kSimulator}
      .text();
}

/// A key of the search's table that may be 7.
std::string key_for_seven(SearchKind kind) {
  SearchOptions options = search_of(kind);
  std::string key;
  const auto look = [&key]<class Value>(const SearchField& field, const Value&) {
    if (std::is_same_v<Value, std::int64_t> && field.least <= 7 && field.most >= 7) key = field.key;
  };
  visit_search_fields(options, look);
  return key;
}

TEST(TargetCampaign, KeepsTheSearchOfAParameterFile) {
  const std::string races = campaign_digest(parsed(searched_by("")));
  EXPECT_EQ(campaign_digest(parsed(searched_by("search = \"irace\"\n"))), races);
  for (const SearchKind kind : all_searches()) {
    if (kind == SearchKind::Irace) continue;
    const std::string name(name_of(kind));
    const Campaign campaign = parsed(searched_by("search = \"" + name + "\"\n"));
    EXPECT_EQ(kind_of(campaign.methods[0].search), kind);
    expect_kept(campaign);
    EXPECT_NE(campaign_digest(campaign), races) << name;
    const std::string key = key_for_seven(kind);
    const Campaign other =
        parsed(searched_by("search = \"" + name + "\"\n[method." + name + "]\n" + key + " = 7\n"));
    expect_kept(other);
    EXPECT_NE(campaign_digest(other), campaign_digest(campaign)) << name;
  }
}

TEST(TargetCampaign, CallsThatNoTaskCanCarryAreRefusedAtTheStart) {
  Method method;
  for (int i = 0; i < 2000; ++i)
    method.parameters +=
        "p" + std::to_string(i) + " \"--" + std::string(100, 'x') + "\" r (0, 1)\n";
  EXPECT_TRUE(MethodSpace::make(method, 4));
  for (int i = 2000; i < 12'000; ++i)
    method.parameters +=
        "p" + std::to_string(i) + " \"--" + std::string(100, 'x') + "\" r (0, 1)\n";
  EXPECT_THAT(complaint_of(MethodSpace::make(method, 4)), HasSubstr("1620890 bytes"));
  // Names are no part of a call, but of the texts that a store keeps for each configuration.
  Method named;
  named.parameters = std::string(1U << 20U, 'n') + " \"\" r (0, 1)\n";
  EXPECT_THAT(complaint_of(MethodSpace::make(named, 4)), HasSubstr("names"));
}

TEST(TargetCampaign, KeepsEveryKeyOfTheTargetAndOfTheRace) {
  const std::string race =
      "max_time = 5000\nparallel = 4\ntest_type = \"t-test-holm\"\ncapping = true\n"
      "bound_max = 20\nbound_digits = 1\nbound_par = 2\nbound_as_timeout = false\n"
      "capping_type = \"worst\"\nbound_type = \"instance\"\ncapping_after_first_test = true\n"
      "budget_estimation = 0.1\nmin_measurable_time = 0.5\npostselection = false\n"
      "test_nb_elites = 3\ntest_iteration_elites = true\nrepair_configuration = \"fix.sh\"\n";
  const std::string target =
      kSimulator +
      "launcher = \"/bin/sh\"\nevaluator = \"eval.sh\"\n"
      "command_line = \"{seed} \\\"{instance}\\\" {bound} {targetRunnerArgs}\"\n"
      "folder = \"runs\"\nretries = 2\ntimeout = \"2 min\"\n"
      "on_timeout = \"reject\"\naclib = false\nbatch_mode = \"slurm\"\n";
  const Campaign campaign = parsed(with_parameters(race, target));
  ASSERT_TRUE(campaign.target);
  EXPECT_EQ(campaign.target->launcher, "/bin/sh");
  EXPECT_EQ(campaign.target->timeout_s, 120);
  EXPECT_TRUE(campaign.target->timeout_is_rejection);
  EXPECT_EQ(campaign.target->batch_mode, BatchMode::Slurm);
  EXPECT_TRUE(campaign.target->prints_time);
  EXPECT_EQ(campaign.target->min_measurable_time, 0.5);
  EXPECT_EQ(campaign.race.test_type, TestType::TTestHolm);
  EXPECT_EQ(campaign.race.capping_type, CappingType::Worst);
  EXPECT_EQ(campaign.race.bound_type, BoundType::Instance);
  EXPECT_EQ(campaign.test_nb_elites, 3);
  EXPECT_THAT(campaign.repair, EndsWith("/in/fix.sh"));
  expect_kept(campaign);
}

TEST(TargetCampaign, ReadsFilesBesideTheCampaignOnce) {
  const TemporaryFolder folder;
  std::ofstream(folder / "p.txt") << "a \"--a \" r (0, 1)\nb \"--b \" i (1, 3)\n";
  std::ofstream(folder / "c.txt") << "a b\n0.5 2\n";
  std::ofstream(folder / "i.txt") << "# sizes\n one two\nthree # with a comment\n\n";
  std::ofstream(folder / "x.toml")
      << FileText{.mission =
                      "name = \"t\"\n[mission.instances]\ntraining_file = \"i.txt\"\n"
                      "test = { count = 3 }\n",
                  .method = "name = \"m\"\nparameters = \"p.txt\"\nconfigurations = \"c.txt\"\n",
                  .race = "max_experiments = 500\n",
                  .rest = kSimulator}
             .text();
  const auto campaign = value_of(read_campaign(folder / "x.toml"));
  EXPECT_EQ(campaign.missions[0].instances.training,
            (std::vector<std::string>{"one two", "three "}));
  EXPECT_EQ(campaign.missions[0].test_count, 3);
  const auto space = value_of(MethodSpace::make(campaign.methods[0], 2));
  ASSERT_EQ(space.initial().size(), 1U);
  EXPECT_EQ(space.initial()[0][1], 2);
  std::filesystem::remove(folder / "p.txt");
  std::filesystem::remove(folder / "c.txt");
  std::filesystem::remove(folder / "i.txt");
  expect_kept(campaign);
}

TEST(TargetCampaign, FaultsOfAFileAreShownInThatFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "p.txt") << "a \"--a \" r (0, 1)\nb \"--b \" i (3, 1)\n";
  EXPECT_THAT(
      complaint_of(parse_campaign(FileText{.mission = "name = \"t\"\n",
                                           .method = "name = \"m\"\nparameters = \"p.txt\"\n",
                                           .rest = kSimulator}
                                      .text(),
                                  folder / "x.toml")),
      HasSubstr("p.txt:2:"));
}

TEST(TargetCampaign, WhatDecidesIsCoveredByTheDigestAndWhatDoesNotIsNot) {
  const std::string plain = campaign_digest(parsed(with_parameters()));
  const auto digest_with = [](const std::string& more) {
    return campaign_digest(parsed(with_parameters("max_experiments = 400\n", kSimulator + more)));
  };
  EXPECT_EQ(digest_with("retries = 3\n"), plain);
  EXPECT_EQ(digest_with("timeout = \"9 s\"\n"), plain);
  EXPECT_NE(digest_with("timeout = \"9 s\"\non_timeout = \"reject\"\n"), plain);
  EXPECT_NE(digest_with("evaluator = \"e.sh\"\n"), plain);
  EXPECT_NE(digest_with("command_line = \"{seed} {instance} {targetRunnerArgs}\"\n"), plain);
  EXPECT_NE(
      campaign_digest(parsed(with_parameters("max_experiments = 400\npostselection = false\n"))),
      plain);
}

TEST(TargetCampaign, AFlavoursMachinesAreGivenAsTextOfTheGrammar) {
  const Campaign campaign =
      parsed(FileText{.mission = "name = \"foraging.argos\"\n", .rest = kSimulator}.text());
  EXPECT_EQ(campaign.missions[0].instances.training, (std::vector<std::string>{"foraging.argos"}));
  const auto space = value_of(MethodSpace::make(campaign.methods[0], 2));
  EXPECT_TRUE(space.neighbourhood());  // machines, and no parameter file
  expect_kept(campaign);
}

TEST(TargetCampaign, ABudgetIsJudgedWithTheParameterFilesSpace) {
  const auto small = complaints(with_parameters("max_experiments = 50\n"));
  EXPECT_THAT(small, ElementsAre(HasSubstr("too small")));
  const auto blocks =
      complaints(with_parameters("max_experiments = 400\nblock_size = 3\nmu = 15\n"));
  ASSERT_THAT(blocks, ElementsAre(HasSubstr("block_size")));
  const auto line_of = [](const std::string& text) {
    return std::stoi(text.substr(text.find(':') + 1));
  };
  EXPECT_EQ(line_of(blocks[0]), line_of(small[0]) + 1) << blocks[0];
}

TEST(TargetCampaign, ProgramsAreLookedForBeforeTheyRun) {
  const TemporaryFolder folder;
  Campaign campaign = parsed(with_parameters());
  campaign.target->folder = folder.path();
  ASSERT_EQ(check_programs(campaign).size(), 1U);
  EXPECT_THAT(check_programs(campaign)[0].message, HasSubstr("no such program"));
  campaign.target->runner = folder / "run.sh";
  std::ofstream(folder / "run.sh") << "#!/bin/sh\n";
  ASSERT_EQ(check_programs(campaign).size(), 1U);
  EXPECT_THAT(check_programs(campaign)[0].message, HasSubstr("chmod +x"));
  std::filesystem::permissions(folder / "run.sh", std::filesystem::perms::owner_all);
  EXPECT_TRUE(check_programs(campaign).empty());
  campaign.target->command_line = "{seed}";
  EXPECT_FALSE(check_programs(campaign).empty());
}

TEST(TargetCampaign, TextsWithAnyBytesComeBack) {
  Campaign campaign = parsed(with_parameters());
  campaign.missions[0].instances.training = {"quote \" and \\", "tab\there", "'''", "\x01", ""};
  campaign.methods[0].parameters += "# a comment with ''' in it\r\n";
  expect_kept(campaign);
}

TEST(IraceCampaign, IsTheRaceOfTheScenario) {
  IraceSetup setup{
      .race = {},
      .seed = 7,
      .space = ParameterSpace::make({{"a", "--a ", Real{0.0, 10.0}, {}}}, {}, 3).value()};
  setup.parameter_text = "a \"--a \" r (0, 10)\n\n[global]\ndigits = 3\n";
  setup.race.max_experiments = 500;
  setup.race.n_instances = 2;
  setup.race.seed = 7;
  setup.training = {"x", "y"};
  setup.test = {"t"};
  setup.exec_dir = "/somewhere";
  setup.target_runner = "/somewhere/target-runner";
  setup.batchmode = "0";
  setup.target_runner_retries = 1;
  setup.test_nb_elites = 2;
  const Campaign campaign = campaign_of(setup, 99);
  EXPECT_EQ(campaign.seed, 7U);
  EXPECT_EQ(campaign.missions[0].mission.name, "tuning");
  EXPECT_EQ(campaign.methods[0].name, "irace");
  EXPECT_EQ(race_on(campaign, campaign.missions[0]).n_instances, 2);
  EXPECT_EQ(campaign.missions[0].test_count, 1);
  EXPECT_EQ(campaign.target->retries, 1);
  EXPECT_EQ(campaign.target->batch_mode, BatchMode::None);
  expect_kept(campaign);
  setup.seed.reset();
  EXPECT_EQ(campaign_of(setup, 99).seed, 99U);
}

}  // namespace
}  // namespace swarmsmith
