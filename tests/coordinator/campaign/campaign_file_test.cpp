#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "sim/files/machine_file.h"
#include "sim/files/profile_file.h"

#include <fstream>
#include <string>

#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using testing::SizeIs;

TEST(CampaignFile, OfTheShortestKindTakesEverythingElseFromDefaults) {
  const Campaign campaign = parsed(FileText{}.text());
  EXPECT_EQ(campaign.name, "x");
  EXPECT_EQ(campaign.store, "in/x.db");
  EXPECT_EQ(campaign.repetitions, 1);
  ASSERT_THAT(campaign.missions, SizeIs(1));
  EXPECT_EQ(campaign.missions[0].mission, *built_in_mission("aggregation"));
  ASSERT_THAT(campaign.methods, SizeIs(1));
  EXPECT_EQ(campaign.methods[0].flavour, "watermelon");
  EXPECT_THAT(campaign.methods[0].behaviours,
              ElementsAre("exploration", "stop", "attraction", "repulsion"));
  EXPECT_THAT(campaign.methods[0].conditions, SizeIs(7));
  EXPECT_EQ(campaign.race.max_experiments, 2000);
  EXPECT_EQ(campaign.race.first_test, 5);
  EXPECT_EQ(campaign.profile.name, "rvr");
  EXPECT_EQ(campaign.local_workers, std::nullopt);
}

TEST(CampaignFile, ReadsWhoStartsWorkers) {
  const FileText plain;
  FileText file;
  file.rest =
      "[workers]\nlauncher = \"slurm\"\nship = true\n[workers.slurm]\njobs = 16\ncpus_per_task = "
      "64\n"
      "time = \"8:00:00\"\npartition = \"long\"\noptions = [\"--account=x\"]\n"
      "[workers.ssh]\nhosts = \"hosts\"\noptions = [\"-F\", \"c\"]\n";
  const Campaign campaign = parsed(file.text());
  EXPECT_EQ(campaign.launch, (LaunchOptions{.kind = LaunchOptions::Kind::Slurm,
                                            .ssh = {.hosts = "in/hosts", .options = {"-F", "c"}},
                                            .slurm = {.jobs = 16,
                                                      .cpus_per_task = 64,
                                                      .time = "8:00:00",
                                                      .partition = "long",
                                                      .options = {"--account=x"}},
                                            .ship = true}));
  EXPECT_EQ(parsed(plain.text()).launch, LaunchOptions{});
  EXPECT_EQ(campaign_digest(campaign), campaign_digest(parsed(plain.text())));
}

TEST(CampaignFile, AnOutlineThatDoesNotFitTheMissionsRobotIsRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "round.toml")
      << "format = 1\nrobots = 2\nrobot = \"epuck\"\n[score]\nkind = \"coverage\"\n";
  const auto with_diameter = [&](const std::string& diameter) {
    return complaint_of(parse_campaign(
        "format = 1\n[[mission]]\npreset = \"round.toml\"\nrobot = { shape = \"circle\", diameter "
        "= " +
            diameter +
            " }\n[[method]]\nname = \"m\"\nflavour = \"chocolate-epuck\"\n[simulator]\n"
            "profile = \"epuck\"\n[race]\nmax_experiments = 2000\n",
        folder / "x.toml"));
  };
  EXPECT_EQ(with_diameter("0.06"), "");
  EXPECT_THAT(with_diameter("0.1"), HasSubstr("rays would start inside of the body"));
}

TEST(CampaignFile, WithoutAProfileHasThatOfItsRobots) {
  const TemporaryFolder folder;
  std::ofstream(folder / "own.toml") << "format = 1\nbase = \"epuck\"\n[drive]\ntrack = 0.06\n";
  const auto profile_of = [&](const std::string& robot) {
    const FileText file{.mission = "name = \"aggregation\"\nrobot = \"" + robot + "\"\n",
                        .method = "name = \"m\"\nflavour = \"chocolate" +
                                  std::string(robot == "rvr" ? "" : "-epuck") + "\"\n",
                        .race = "max_experiments = 100000\n"};
    const auto campaign = value_of(parse_campaign(file.text(), folder / "x.toml"));
    EXPECT_EQ(campaign.profile, built_in_profile(campaign.profile.name).value());
    EXPECT_EQ(campaign_digest(value_of(parse_campaign(normalised_text(campaign), "stored.toml"))),
              campaign_digest(campaign));
    return campaign.profile.name;
  };
  EXPECT_EQ(profile_of("rvr"), "rvr");
  EXPECT_EQ(profile_of("epuck"), "epuck");
  EXPECT_EQ(profile_of("own.toml"), "epuck");
}

TEST(CampaignFile, SaysWhichProfilesFitTheRobot) {
  const FileText file{.mission = "name = \"aggregation\"\nrobot = \"epuck\"\n",
                      .method = "name = \"m\"\nflavour = \"chocolate-epuck\"\n",
                      .race = "max_experiments = 100000\n",
                      .rest = "[simulator]\nprofile = \"rvr\"\n"};
  EXPECT_THAT(complaints(file.text()),
              ElementsAre(HasSubstr("choose another profile (argos3, epuck, epuck-ideal, "
                                    "epuck-pseudo-reality), or a mission of another robot")));
}

TEST(CampaignFile, HasNoMoreDesignsThanAStoreNumbers) {
  const auto complaints_of_repetitions = [](const std::string& number) {
    return complaints(
        FileText{.campaign = "repetitions = " + number + "\n", .race = "max_experiments = 2000\n"}
            .text());
  };
  EXPECT_THAT(complaints_of_repetitions("34359"), IsEmpty());
  EXPECT_THAT(complaints_of_repetitions("34360"),
              ElementsAre("in/x.toml:3:15: the campaign would have 34360 designs, and at most "
                          "34359 are possible: take fewer repetitions, missions or methods, or "
                          "make two campaigns"));
}

TEST(CampaignFile, HasNoMoreExperimentsThanItsCandidatesHaveNumbers) {
  const auto complaints_of_budget = [](const std::string& number, const std::string& method) {
    return complaints(FileText{.method = "name = \"m\"\nflavour = \"watermelon\"\n" + method,
                               .race = "max_experiments = " + number + "\n"}
                          .text());
  };
  EXPECT_THAT(complaints_of_budget("5_000_000", ""), IsEmpty()) << "each races on five pairs";
  EXPECT_THAT(complaints_of_budget("5_000_001", ""),
              ElementsAre("in/x.toml:9:19: method \"m\": with so many experiments it may try more "
                          "than 1000000 candidates, the most that a design can have: at most "
                          "5000000 experiments are possible"));
  EXPECT_THAT(complaints_of_budget("1_000_000", "search = \"random\"\n"), IsEmpty());
  EXPECT_THAT(complaints_of_budget("1_000_001", "search = \"random\"\n"),
              ElementsAre(HasSubstr("at most 1000000 experiments are possible")));
}

TEST(CampaignFile, TheSmallestBudgetsAreNoLargerThanItsCandidatesHaveNumbers) {
  const auto complaints_of_race = [](const std::string& race) {
    return complaints(FileText{.race = "max_experiments = 2_000\n" + race}.text());
  };
  EXPECT_THAT(complaints_of_race("min_experiments = 5_000_000\n"), IsEmpty());
  EXPECT_THAT(complaints_of_race("min_experiments = 5_000_001\n"),
              ElementsAre("in/x.toml:9:19: method \"watermelon\": with so many experiments it may "
                          "try more than 1000000 candidates, the most that a design can have: at "
                          "most 5000000 experiments are possible"));
  EXPECT_THAT(complaints_of_race("min_experiments = 100\nnb_iterations = 1_000_000\n"),
              ElementsAre(HasSubstr("at most 5000000 experiments are possible")))
      << "the smallest budget that works is larger";
}

TEST(CampaignFile, ReadsFurtherProfilesOfTheTests) {
  const FileText plain;
  FileText file;
  file.rest = "[tests]\nprofiles = [\"rvr\", \"pseudo-reality\", \"argos3\"]\n";
  const Campaign campaign = parsed(file.text());
  ASSERT_THAT(campaign.test_profiles, SizeIs(2)) << "its own is not a further one";
  EXPECT_EQ(campaign.test_profiles[0], *built_in_profile("pseudo-reality"));
  EXPECT_EQ(campaign.test_profiles[1], *built_in_profile("argos3"));
  EXPECT_NE(campaign_digest(campaign), campaign_digest(parsed(plain.text())));
  EXPECT_EQ(parsed(normalised_text(campaign)).test_profiles, campaign.test_profiles);
  file.rest = "[tests]\nprofiles = [\"rvr\"]\n";
  EXPECT_EQ(campaign_digest(parsed(file.text())), campaign_digest(parsed(plain.text())));
}

TEST(CampaignFile, FurtherProfilesOfTheTestsHaveNamesOfTheirOwn) {
  const auto said = [](const std::string& tests) {
    FileText file;
    file.rest = "[tests]\n" + tests + "\n";
    return complaints(file.text());
  };
  EXPECT_THAT(said("profiles = [\"argos3\", \"argos3\"]"),
              ElementsAre(HasSubstr("the profile argos3 is named twice")));
  EXPECT_THAT(said("profiles = [\"argos\"]"), ElementsAre(HasSubstr("did you mean \"argos3\"")));
  EXPECT_THAT(said("profiles = [\"none.toml\"]"),
              ElementsAre(HasSubstr("there is no such profile file")));
  EXPECT_THAT(said("profiles = [\"rvr\"]\nmore = 1"), ElementsAre(HasSubstr("`more`")));
  EXPECT_THAT(said("[[tests.profile]]\nname = \"real\""),
              ElementsAre(HasSubstr("scores of the source real are not simulated")));
  EXPECT_THAT(said("[[tests.profile]]\nname = \"rvr\"\n[tests.profile.proximity]\nsd = 0.3"),
              ElementsAre(HasSubstr("the campaign has another profile rvr")));
}

TEST(CampaignFile, ReadsTheKeysOfEverySection) {
  const Campaign campaign = parsed(FileText{
      .campaign = "name = \"trial\"\nseed = 1234\nrepetitions = 10\nstore = \"sub/y.db\"\n",
      .race = "max_experiments = 100_000\nconfidence = 0.9\nmu = 7\nsoft_restart = false\n"
              "test_type = \"F-test\"\nelitist = true\ndigits = 3\nelitist_limit = 0\n",
      .rest = "[simulator]\nkind = \"builtin\"\nprofile = \"argos3\"\n"
              "[workers]\nlocal = 2\nbind = \"127.0.0.1:5555\"\ntimeout = \"2 min\"\nretries = 5\n"
              "on_failure = \"stop\"\n[dashboard]\nbind = \"127.0.0.1:8347\"\n"}
                                       .text());
  EXPECT_EQ(campaign.name, "trial");
  EXPECT_EQ(campaign.seed, 1234U);
  EXPECT_EQ(campaign.repetitions, 10);
  EXPECT_EQ(campaign.store, "in/sub/y.db");
  EXPECT_EQ(campaign.race.max_experiments, 100'000);
  EXPECT_EQ(campaign.race.confidence, 0.9);
  EXPECT_EQ(campaign.race.mu, 7);
  EXPECT_FALSE(campaign.race.soft_restart);
  EXPECT_EQ(campaign.race.elitist_limit, 0);
  EXPECT_EQ(campaign.digits, 3);
  EXPECT_EQ(campaign.profile.name, "argos3");
  EXPECT_EQ(campaign.local_workers, 2);
  EXPECT_EQ(campaign.bind, "127.0.0.1:5555");
  EXPECT_EQ(campaign.task_timeout_s, 120);
  EXPECT_EQ(campaign.retries, 5);
  EXPECT_TRUE(campaign.stop_on_failure);
}

TEST(CampaignFile, ReadsAMethodOfChocolateWithItsModules) {
  const Campaign campaign =
      parsed(FileText{.method = "name = \"c\"\nflavour = \"chocolate\"\n"}.text());
  EXPECT_THAT(campaign.methods[0].behaviours,
              ElementsAre("exploration", "stop", "phototaxis", "anti_phototaxis", "attraction",
                          "repulsion"));
  EXPECT_THAT(campaign.methods[0].conditions,
              ElementsAre("black_floor", "gray_floor", "white_floor", "neighbour_count",
                          "inverted_neighbour_count", "fixed_probability"));
}

TEST(CampaignFile, ReadsWhatTurnsAreMeasuredIn) {
  const auto clock = [](const std::string& keys) {
    return parsed(FileText{.method = "name = \"m\"\n" + keys}.text()).methods[0].turn_clock;
  };
  EXPECT_EQ(clock(""), TurnClock::Cycles);
  EXPECT_EQ(clock("turn_clock = \"cycles\"\n"), TurnClock::Cycles);
  EXPECT_EQ(clock("turn_clock = \"seconds\"\n"), TurnClock::Seconds);
}

TEST(CampaignFile, ReadsAMissionOfItsOwn) {
  const Campaign campaign = parsed(FileText{.mission = R"(name = "shelter"
duration = "60.5 s"
robots = 2
  [mission.arena]
  shape = "dodecagon"
  area  = 4.91
  floor = "white"
  spots = [ { shape = "circle", x = 0.1, y = -0.2, diameter = 0.6, color = "#102030" },
            { shape = "square", x = 0, y = 0.5, side = 0.3, color = "red" } ]
  [mission.score]
  kind     = "robots_on"
  color    = "red"
  at       = "end"
  maximize = true
  [mission.instances]
  training = { placement = "uniform" }
  test     = { count = 20 }
)"}
                                       .text());
  ASSERT_THAT(campaign.missions, SizeIs(1));
  const Mission& mission = campaign.missions[0].mission;
  EXPECT_EQ(mission.name, "shelter");
  EXPECT_EQ(mission.cycles, 605);
  EXPECT_EQ(mission.robots, 2);
  EXPECT_NEAR(area_of(mission.arena), 4.91, 1e-9);
  EXPECT_EQ(mission.arena.floor, (Rgb{255, 255, 255}));
  EXPECT_THAT(mission.arena.patches,
              ElementsAre(Patch{Disc{{0.1, -0.2}, 0.3}, {0x10, 0x20, 0x30}},
                          Patch{Rectangle{{0, 0.5}, 0.3, 0.3}, {255, 0, 0}}));
  EXPECT_EQ(mission.rule, ScoreRule(RobotsOn{{255, 0, 0}}));
  EXPECT_EQ(campaign.missions[0].test_count, 20);
  EXPECT_NEAR(std::get<PlaceInDisc>(mission.placement).radius_m, 1.2 * 1.2357 / 1.226, 1e-4);
}

TEST(CampaignFile, TakesAPresetAndChangesIt) {
  const Campaign campaign = parsed(
      FileText{.mission = "name = \"long\"\npreset = \"grid_exploration\"\nduration = \"10 min\"\n"}
          .text());
  Mission wanted = *built_in_mission("grid_exploration");
  wanted.name = "long";
  wanted.cycles = 6000;
  EXPECT_EQ(campaign.missions[0].mission, wanted);
}

TEST(CampaignFile, TakesMissionsAndProfilesFromFilesBesideIt) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("shelter.toml",
        "format = 1\nrobots = 2\n[score]\nkind = \"robots_on\"\ncolor = \"white\"\n"
        "[instances]\ntest = { count = 7 }\n");
  write("mine.toml", "format = 1\nbase = \"argos3\"\n[proximity]\nsd = 0.02\n");
  write("campaign.toml",
        FileText{.mission = "preset = \"shelter.toml\"\n[[mission]]\nname = \"night\"\n"
                            "preset = \"shelter.toml\"\nrobots = 5\n",
                 .rest = "[simulator]\nprofile = \"mine.toml\"\n"}
            .text());
  const auto campaign = value_of(read_campaign(folder / "campaign.toml"));
  ASSERT_THAT(campaign.missions, SizeIs(2));
  EXPECT_EQ(campaign.missions[0].mission.name, "shelter");
  EXPECT_EQ(campaign.missions[0].test_count, 7);
  EXPECT_EQ(campaign.missions[1].mission.name, "night");
  EXPECT_EQ(campaign.missions[1].mission.robots, 5);
  EXPECT_EQ(campaign.profile, (Profile{.name = "mine", .proximity = {.sd_m = 0.02}}));
}

TEST(CampaignFile, TellsWhatIsWrongInFilesThatItNames) {
  const TemporaryFolder folder;
  std::ofstream(folder / "m.toml") << "format = 1\nrobots = 0\npreset = \"aggregation\"\n";
  std::ofstream(folder / "rvr.toml") << "format = 1\n[proximity]\nsd = 0.5\n";
  std::ofstream(folder / "c.toml") << FileText{.mission = "preset = \"m.toml\"\n",
                                               .rest = "[simulator]\nprofile = \"rvr.toml\"\n"}
                                          .text();
  const auto campaign = read_campaign(folder / "c.toml");
  ASSERT_FALSE(campaign);
  ASSERT_THAT(campaign.error(), SizeIs(2));
  EXPECT_EQ(campaign.error()[0].where, (folder / "m.toml").string() + ":2:10");
  EXPECT_EQ(campaign.error()[1].where, (folder / "rvr.toml").string());
  EXPECT_THAT(campaign.error()[1].message, HasSubstr("`rvr` is built in with other values"));
}

TEST(CampaignFile, RefusesAProfileInATableThatTakesTheNameOfABuiltInOne) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& profile) {
    std::ofstream(folder / "c.toml") << FileText{.rest = profile}.text();
    return read_campaign(folder / "c.toml");
  };
  const std::string text = text_of(profile_sections(built_in_profile("argos3").value(), "P"));
  for (const std::string header : {"[simulator.profile", "[[tests.profile]]"}) {
    const bool is_list = header.ends_with("]");
    std::string table = text;
    table.replace(table.find("[P]"), 3, is_list ? header : header + "]");
    for (std::size_t at = 0; (at = table.find("[P.")) != std::string::npos;)
      table.replace(at, 2, is_list ? "[tests.profile" : "[simulator.profile");
    const auto same = read(table);
    EXPECT_TRUE(same) << to_string(same.error()[0]);
    const std::size_t rate = table.find("miss_rate = ");
    table.replace(rate, table.find('\n', rate) - rate, "miss_rate = 0.5");
    const auto other = read(table);
    ASSERT_FALSE(other) << header;
    EXPECT_THAT(other.error()[0].message, HasSubstr("`argos3` is built in with other values"));
    EXPECT_TRUE(parse_campaign(FileText{.rest = table}.text(), "stored.toml"));
  }
}

TEST(CampaignFile, RefusesAProfileThatTakesTheNameOfScoresOfAnotherKind) {
  const TemporaryFolder folder;
  for (const std::string name : {"real", "command"}) {
    std::ofstream(folder / (name + ".toml")) << "format = 1\nbase = \"rvr\"\n";
    for (const std::string& profile : {"profile = \"" + name + ".toml\"\n",
                                       "profile = { base = \"rvr\", name = \"" + name + "\" }\n"}) {
      const std::string text = FileText{.rest = "[simulator]\n" + profile}.text();
      std::ofstream(folder / "c.toml") << text;
      const auto campaign = read_campaign(folder / "c.toml");
      ASSERT_FALSE(campaign) << profile;
      EXPECT_EQ(campaign.error()[0].message, "scores of the source " + name +
                                                 " are not simulated; give the profile another "
                                                 "name");
      EXPECT_TRUE(parse_campaign(text, folder / "stored.toml")) << "stores that have it are read";
    }
  }
}

TEST(CampaignFile, OrdersRewardsByColourWhateverTheOrderAndSpelling) {
  const auto rule = [](const std::string& rewards) {
    const std::string score = "score = { kind = \"color_reward\", rewards = " + rewards + " }\n";
    return parsed(FileText{.mission = "name = \"x\"\n" + score}.text()).missions[0].mission.rule;
  };
  const ScoreRule wanted = ColorReward{{{{127, 127, 127}, 0.5}, {{255, 255, 0}, 2}}};
  EXPECT_EQ(rule("{ yellow = 2, gray = 0.5 }"), wanted);
  EXPECT_EQ(rule("{ grey = 0.5, \"#ffff00\" = 2 }"), wanted);
}

TEST(CampaignFile, OrdersModulesAsTheFlavourDoes) {
  const Campaign campaign =
      parsed(FileText{.method = "name = \"m\"\nbehaviours = [\"stop\", \"exploration\"]\n"
                                "conditions = [\"fixed_probability\", \"black_floor\"]\n"}
                 .text());
  EXPECT_THAT(campaign.methods[0].behaviours, ElementsAre("exploration", "stop"));
  EXPECT_THAT(campaign.methods[0].conditions, ElementsAre("black_floor", "fixed_probability"));
}

TEST(CampaignFile, ReadsRangesOfParameters) {
  const Campaign campaign = parsed(FileText{.method = R"(name = "m"
  [method.parameters]
  exploration.tau  = { int  = [1, 50] }
  attraction.alpha = { real = [1.5, 5] }
)"}
                                       .text());
  EXPECT_THAT(campaign.methods[0].ranges, ElementsAre(RangeOverride{"attraction", "alpha", 1.5, 5},
                                                      RangeOverride{"exploration", "tau", 1, 50}));
}

TEST(CampaignFile, OfABudgetThatFlagsMadeTooSmallNamesTheSmallestThatWorks) {
  Campaign campaign = parsed(FileText{}.text());
  EXPECT_TRUE(check_budget(campaign).empty());
  campaign.race.max_experiments = 1349;
  const auto errors = check_budget(campaign);
  ASSERT_THAT(errors, SizeIs(1));
  EXPECT_THAT(errors[0].message, HasSubstr("1350"));
}

TEST(CampaignFile, OfTheDemoIsShort) {
  const Campaign demo = demo_campaign();
  EXPECT_EQ(demo.name, "demo");
  EXPECT_EQ(demo.store, "demo.db");
  EXPECT_EQ(demo.race.max_experiments, 2000);
  EXPECT_EQ(demo.missions[0].mission.name, "color_selection");
  ASSERT_THAT(demo.methods, SizeIs(3));
  EXPECT_EQ(demo.methods[0].baseline, "");
  EXPECT_THAT(demo.methods[1].baseline, StartsWith("--nstates 2 --s0 0"));
  EXPECT_EQ(demo.methods[2].baseline, kRandomMachine);
}

// --- Baselines -----------------------------------------------------------------------------------

constexpr const char* kStop = "--nstates 1 --s0 1";

std::string with_method(const std::string& keys) {
  return FileText{}.text() + "[[method]]\nname = \"other\"\n" + keys;
}

TEST(Baseline, IsATextOrTheWordRandom) {
  const Campaign campaign =
      parsed(with_method("baseline = \"--nstates   1 --s0 1\"\n[[method]]\nname = \"chance\"\n"
                         "baseline = \"random\"\nmax_states = 2\n"));
  EXPECT_EQ(campaign.methods[1].baseline, kStop);
  EXPECT_EQ(campaign.methods[2].baseline, "random");
  EXPECT_EQ(campaign.methods[2].max_states, 2);
  const Campaign again = parsed(normalised_text(campaign));
  EXPECT_EQ(again.methods, campaign.methods);
}

TEST(Baseline, ChangesTheDigestAndOtherCampaignsKeepTheirs) {
  const Campaign one = parsed(with_method("baseline = \"random\"\n"));
  const Campaign other = parsed(with_method(""));
  EXPECT_NE(campaign_digest(one), campaign_digest(other));
  EXPECT_THAT(normalised_text(other), Not(HasSubstr("baseline")));
}

TEST(Baseline, HasNoBudget) {
  const auto rows = design_rows(parsed(with_method("baseline = \"random\"\n")));
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_GT(rows[0].budget, 0);
  EXPECT_EQ(rows[1].budget, 0);
}

TEST(Baseline, OfAFileFollowsItsHead) {
  const TemporaryFolder folder;
  std::ofstream(folder / "hand.fsm")
      << head_text({.flavour = "watermelon-argos3"}) << kStop << "\n";
  const auto read = [&](const std::string& keys) {
    return parse_campaign(with_method(keys), folder / "campaign.toml");
  };
  const auto campaign = value_of(read("baseline = \"hand.fsm\"\n"));
  EXPECT_EQ(campaign.methods[1].flavour, "watermelon-argos3");
  EXPECT_EQ(campaign.methods[1].baseline, kStop);
  EXPECT_THAT(complaint_of(read("baseline = \"hand.fsm\"\nflavour = \"chocolate\"\n")),
              HasSubstr("designed for the flavour watermelon-argos3"));
}

TEST(Baseline, ThatIsWrongIsComplainedOf) {
  const auto message = [](const std::string& keys) {
    const auto campaign = parse_campaign(with_method(keys), "/nowhere/campaign.toml");
    return campaign ? std::string("nothing") : to_string(campaign.error().front());
  };
  EXPECT_THAT(message("baseline = \"--nstates 1 --s0 9\"\n"), HasSubstr("token 4"));
  EXPECT_THAT(message("baseline = \"hand.fsm\"\n"), HasSubstr("hand.fsm"));
  for (const std::string wrong : {"", "Random", "-nstates 1 --s0 1"}) {
    EXPECT_THAT(message("baseline = \"" + wrong + "\"\n"),
                HasSubstr("or \"random\", not \"" + wrong + "\""));
  }
  EXPECT_THAT(message("baseline = \"--nstates 1 --s0 1\"\nmax_states = 2\n"),
              HasSubstr("the method's `baseline` is a machine"));
}

}  // namespace
}  // namespace swarmsmith
