#include <ostream>

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/method_space.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using ::testing::Pair;

FileText file_of(const std::string& method) {
  return FileText{.method = "name = \"m\"\n" + method, .race = "max_experiments = 100000\n"};
}

Campaign campaign_of(const std::string& method) {
  return parsed(file_of(method).text());
}

std::string complaint_about(const std::string& method, const std::string& race = "") {
  FileText file = file_of(method);
  file.race += race;
  const auto read = parse_campaign(file.text(), "x.toml");
  return read ? "read" : to_string(read.error().front());
}

struct PresetCase {
  std::string preset;
  Architecture architecture;
  SearchKind search;
};

void PrintTo(const PresetCase& preset, std::ostream* out) {
  *out << preset.preset;
}

class Presets : public ::testing::TestWithParam<PresetCase> {};

INSTANTIATE_TEST_SUITE_P(
    All, Presets,
    ::testing::Values(PresetCase{"random", Architecture::Machine, SearchKind::Random},
                      PresetCase{"vanilla", Architecture::Machine, SearchKind::FRace},
                      PresetCase{"evostick", Architecture::Network, SearchKind::Evolution},
                      PresetCase{"cma-es", Architecture::Network, SearchKind::CmaEs},
                      PresetCase{"icepop", Architecture::Machine, SearchKind::Annealing},
                      PresetCase{"maple", Architecture::Tree, SearchKind::Irace}),
    [](const auto& tested) {
      std::string name = tested.param.preset;
      std::erase(name, '-');
      return name;
    });

TEST_P(Presets, AreTheSameCampaignAsTheirPair) {
  const PresetCase& preset = GetParam();
  const Campaign named = campaign_of("method = \"" + preset.preset + "\"\n");
  EXPECT_EQ(named.methods[0].architecture, preset.architecture);
  EXPECT_EQ(kind_of(named.methods[0].search), preset.search);
  const Campaign explicitly =
      campaign_of("architecture = \"" + std::string(name_of(preset.architecture)) +
                  "\"\nsearch = \"" + std::string(name_of(preset.search)) + "\"\n");
  EXPECT_EQ(campaign_digest(named), campaign_digest(explicitly));
  EXPECT_NE(campaign_digest(named), campaign_digest(campaign_of("")));
}

TEST_P(Presets, ReadBackFromTheTextThatStoresHave) {
  for (const char* flavour : {"watermelon", "chocolate"}) {
    const Campaign campaign = campaign_of("flavour = \"" + std::string(flavour) +
                                          "\"\nmethod = \"" + GetParam().preset + "\"\n");
    const auto again = value_of(parse_campaign(normalised_text(campaign), "x.toml"));
    EXPECT_EQ(again.methods, campaign.methods);
    EXPECT_EQ(campaign_digest(again), campaign_digest(campaign));
  }
}

TEST_P(Presets, NameTheirSearchsVersionInTheAnswer) {
  const auto entries = deciding(campaign_of("method = \"" + GetParam().preset + "\"\n"));
  const std::string key = "search." + std::string(name_of(GetParam().search)) + ".version";
  if (GetParam().search == SearchKind::Irace) {
    EXPECT_THAT(entries, Not(Contains(Pair(HasSubstr("search."), "1"))));
  } else {
    EXPECT_THAT(entries, Contains(Pair(key, "1")));
  }
}

TEST_P(Presets, MakeControlSoftwareThatReadsBack) {
  const Campaign campaign = campaign_of("method = \"" + GetParam().preset + "\"\n");
  const auto space = value_of(MethodSpace::make(campaign.methods[0], 4));
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    const Configuration drawn = sample_uniform(space.parameters(), rng).value();
    const CandidateText text = space.text_of(drawn);
    const auto read = parse_controller(text.call, watermelon());
    ASSERT_TRUE(read) << text.call;
    EXPECT_EQ(*read, space.controller_of(drawn));
    EXPECT_EQ(architecture_of(*read), GetParam().architecture);
  }
}

TEST(Methods, WithoutKeysAreIteratedRacesOfMachinesAndKeepTheirDigest) {
  const Campaign plain = campaign_of("");
  EXPECT_EQ(kind_of(plain.methods[0].search), SearchKind::Irace);
  EXPECT_EQ(campaign_digest(plain),
            campaign_digest(campaign_of("architecture = \"machine\"\nsearch = \"irace\"\n")));
  for (const auto& [key, value] : deciding(plain)) {
    EXPECT_THAT(key, Not(HasSubstr("search")));
    EXPECT_THAT(key, Not(HasSubstr("architecture")));
  }
}

TEST(Methods, SpacesAreAsLargeAsTheirArchitectures) {
  const auto size = [](const std::string& method) {
    return MethodSpace::make(campaign_of(method).methods[0], 4)->parameters().size();
  };
  EXPECT_EQ(size("architecture = \"tree\"\n"), 45U);
  EXPECT_EQ(size("architecture = \"tree\"\nflavour = \"chocolate\"\n"), 41U);
  EXPECT_EQ(size("architecture = \"tree\"\nmax_subtrees = 1\n"), 11U);
  EXPECT_EQ(size("method = \"evostick\"\n"), 26U);
  EXPECT_EQ(size("method = \"evostick\"\nflavour = \"chocolate\"\n"), 30U);
  EXPECT_EQ(size("method = \"evostick\"\n[method.network]\ninputs = \"rvr-gray\"\n"), 22U);
}

TEST(Methods, SaysWhatDoesNotFitTogether) {
  EXPECT_THAT(complaint_about("method = \"evostik\"\n"), HasSubstr("evostick"));
  EXPECT_THAT(complaint_about("search = \"cmaes\"\n"), HasSubstr("cma-es"));
  EXPECT_THAT(complaint_about("architecture = \"net\"\n"), HasSubstr("network"));
  EXPECT_THAT(complaint_about("method = \"maple\"\nsearch = \"random\"\n"),
              HasSubstr("sets architecture and search already: tree and irace"));
  EXPECT_THAT(
      complaint_about("[method.evolution]\npopulation = 10\n"),
      HasSubstr("[method.evolution] is for the search evolution, and this method's search is "
                "irace"));
  EXPECT_THAT(complaint_about("method = \"evostick\"\n[method.evolution]\npopulatoin = 10\n"),
              HasSubstr("population"));
  EXPECT_THAT(complaint_about("[method.network]\ninputs = \"rvr\"\n"),
              HasSubstr("is for networks"));
  EXPECT_THAT(complaint_about("method = \"evostick\"\nmax_states = 2\n"),
              HasSubstr("`max_states` is for machines"));
  EXPECT_THAT(complaint_about("max_subtrees = 2\n"), HasSubstr("`max_subtrees` is for trees"));
  EXPECT_THAT(complaint_about("method = \"evostick\"\n[method.network]\ninputs = \"rm1.2\"\n"),
              HasSubstr("the flavour watermelon does not have"));
  EXPECT_THAT(complaint_about("search = \"cma-es\"\n"),
              HasSubstr(":7:10: the search cma-es needs reals without conditions"));
  EXPECT_THAT(complaint_about("architecture = \"tree\"\nsearch = \"evolution\"\n"),
              HasSubstr("and a tree has modules to choose"));
  EXPECT_THAT(complaint_about("method = \"evostick\"\nbehaviours = [\"stop\"]\n"),
              HasSubstr("`behaviours` is for machines and trees"));
  EXPECT_THAT(complaint_about("method = \"icepop\"\n[method.annealing]\nwindow = 2\nmoved = 3\n"),
              HasSubstr("at most `window`"));
  EXPECT_THAT(complaint_about("method = \"icepop\"\n[method.annealing]\nend_temperature = 2\n"),
              HasSubstr("`end_temperature` (2) must be at most `start_temperature` (1)"));
  EXPECT_EQ(complaint_about("method = \"icepop\"\n[method.annealing]\nstart_temperature = 0\n"),
            "read");
  EXPECT_THAT(complaint_about("method = \"evostick\"\n[method.evolution]\nparents = 0.1\n"),
              HasSubstr("`elites` (0.2) must be at most `parents` (0.1)"));
  EXPECT_THAT(
      complaint_about("method = \"random\"\n", "first_test = 3\n"),
      HasSubstr("`first_test` is an option of races, and no method of this campaign races"));
  EXPECT_THAT(complaint_about("method = \"vanilla\"\n", "nb_iterations = 3\n"),
              HasSubstr("`nb_iterations` is for the search irace"));
  EXPECT_EQ(complaint_about("method = \"vanilla\"\n", "elitist = true\nfirst_test = 3\n"), "read");
}

TEST(Methods, NameTheLeastBudgetThatWorks) {
  FileText file = file_of("method = \"evostick\"\n");
  file.race = "max_experiments = 500\n";
  EXPECT_THAT(complaint_of(parse_campaign(file.text(), "x.toml")),
              HasSubstr("must be at least 1100"));
}

TEST(Methods, OfBaselinesMayBeAnyArchitecture) {
  const Campaign campaign = campaign_of(
      "baseline = \"--nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 1 --n01 5 "
      "--a01 1 --p01 0\"\n");
  EXPECT_THAT(campaign.methods[0].baseline, HasSubstr("--nroot 3"));
  const auto again = value_of(parse_campaign(normalised_text(campaign), "x.toml"));
  EXPECT_EQ(again.methods, campaign.methods);
}

TEST(Methods, OfBaselinesAreNotSearchedFor) {
  const std::string machine = "baseline = \"--nstates 1 --s0 1\"\n";
  EXPECT_EQ(complaint_about(machine + "architecture = \"machine\"\n"), "read");
  EXPECT_THAT(complaint_about(machine + "architecture = \"tree\"\n"),
              HasSubstr("`baseline` is a machine, and `architecture` says tree"));
  EXPECT_THAT(complaint_about(machine + "max_subtrees = 1\n"),
              HasSubstr("`max_subtrees` says what a race may try"));
  for (const std::string& baseline : {machine, std::string("baseline = \"random\"\n")}) {
    EXPECT_THAT(complaint_about(baseline + "method = \"evostick\"\n"),
                HasSubstr("`method` says how control software is searched for, and a `baseline` is "
                          "not searched for"));
    EXPECT_THAT(complaint_about(baseline + "search = \"random\"\n"),
                HasSubstr("`search` says how control software is searched for"));
    EXPECT_THAT(complaint_about(baseline + "[method.irace]\n"), HasSubstr("irace"));
    EXPECT_THAT(complaint_about(baseline + "[method.evolution]\nruns = 3\n"),
                HasSubstr("[method.evolution] is for the search evolution"));
  }
  EXPECT_THAT(complaint_about(machine + "[method.network]\ninputs = \"rvr\"\n"),
              HasSubstr("`network` says what a race may try"));
  EXPECT_EQ(complaint_about("baseline = \"random\"\narchitecture = \"tree\"\nmax_subtrees = 2\n"),
            "read");
}

TEST(Methods, SayAFaultOnceAndWhatWasMeant) {
  const auto complaints = [](const std::string& method) {
    return complaints_of(parse_campaign(file_of(method).text(), "x.toml"));
  };
  EXPECT_THAT(complaints("method = \"evostick\"\narchitecture = \"machine\"\n"),
              ElementsAre(HasSubstr("sets architecture and search already")));
  EXPECT_THAT(complaints("method = \"maple\"\nsearch = \"evolution\"\n"),
              ElementsAre(HasSubstr("sets architecture and search already")));
  EXPECT_THAT(complaints("search = \"frace\"\n"),
              ElementsAre(HasSubstr("did you mean \"f-race\"?")));
  EXPECT_THAT(complaints("search = \"f-race\"\n[method.f_race]\nconfigurations = 30\n"),
              ElementsAre(HasSubstr("has no key `f_race` (did you mean \"f-race\"?)")));
  EXPECT_THAT(complaints("architecture = \"network\"\n[method.netwrok]\ninputs = \"rvr\"\n"),
              ElementsAre(HasSubstr("(did you mean \"network\"?)")));
}

TEST(Methods, RefuseWhatDecidesNothing) {
  EXPECT_THAT(complaint_about("method = \"evostick\"\nturn_clock = \"seconds\"\n"),
              HasSubstr("`turn_clock` is for machines and trees"));
  EXPECT_THAT(complaint_about("method = \"icepop\"\n[method.annealing]\ncooling = \"published\"\n"
                              "start_temperature = 2\n"),
              HasSubstr("`start_temperature` is for geometric cooling; the published one begins at "
                        "125 score units"));
  EXPECT_THAT(complaint_about("method = \"icepop\"\n[method.annealing]\ncooling = \"published\"\n"
                              "end_temperature = 0.5\n"),
              HasSubstr("`end_temperature` is for geometric cooling"));
  EXPECT_EQ(complaint_about("method = \"icepop\"\n[method.annealing]\ncooling = \"published\"\n"),
            "read");
}

TEST(Methods, RefuseARepairThatTheirSearchWouldNotUse) {
  const std::string race = "repair_configuration = \"./repair\"\n";
  for (const char* unused : {"evostick", "cma-es", "icepop"}) {
    EXPECT_THAT(complaint_about("method = \"" + std::string(unused) + "\"\n", race),
                HasSubstr("repair_configuration: is for irace, f-race and random"));
  }
  for (const char* used : {"random", "vanilla", "maple"})
    EXPECT_EQ(complaint_about("method = \"" + std::string(used) + "\"\n", race), "read");
}

TEST(Methods, ThatSeeLightWantARobotWhoseSensorsGiveWhatTheyTake) {
  const auto complaints_of = [](const std::string& base, const std::string& reading,
                                const std::string& flavour) {
    const std::string profile = base == "rvr" ? "rvr" : "epuck";
    return complaints(FileText{.mission = "name = \"aggregation\"\n[mission.robot]\nbase = \"" +
                                          base + "\"\n[mission.robot.light]\nreading = \"" +
                                          reading + "\"\n",
                               .method = "name = \"m\"\nflavour = \"" + flavour + "\"\n",
                               .race = "max_experiments = 100000\n",
                               .rest = "[simulator]\nprofile = \"" + profile + "\"\n"}
                          .text());
  };
  EXPECT_THAT(complaints_of("rvr", "lux", "chocolate"), IsEmpty());
  EXPECT_THAT(complaints_of("rvr", "strength", "watermelon"), IsEmpty());  // which sees no light
  EXPECT_THAT(complaints_of("rvr", "strength", "chocolate"),
              ElementsAre(HasSubstr("takes lux from light sensors, but the robot `rvr` gives "
                                    "strengths; choose another flavour")));
  EXPECT_THAT(complaints_of("epuck", "strength", "chocolate-epuck"), IsEmpty());
}

TEST(Methods, OfSingleSensorsWantARobotThatHasThemAll) {
  const auto complaints_of = [](const std::string& lights, const std::string& method) {
    return complaints(FileText{.mission = "name = \"aggregation\"\n[mission.robot]\nbase = "
                                          "\"epuck\"\n[mission.robot.light]\nangles = " +
                                          lights + "\n",
                               .method = "name = \"m\"\nflavour = \"chocolate-epuck\"\n" + method,
                               .race = "max_experiments = 100000\n",
                               .rest = "[simulator]\nprofile = \"epuck\"\n"}
                          .text());
  };
  const std::string network = "architecture = \"network\"\n";
  EXPECT_THAT(complaints_of("[0, 1, 2, 3, 4, 5, 6, 7]", network), IsEmpty());
  EXPECT_THAT(complaints_of("[0, 180]", ""), IsEmpty());
  const std::string why =
      "mission \"aggregation\": a network with the inputs rm1.1 reads the strengths of 8 "
      "proximity and 8 light sensors, but the robot `epuck` has 8 and 2; choose other inputs, or a "
      "mission of another robot";
  EXPECT_THAT(complaints_of("[0, 180]", network), ElementsAre(HasSubstr(why)));
  std::string weights = "0";
  for (int i = 1; i < 50; ++i)
    weights += ",0";
  EXPECT_THAT(
      complaints_of("[0, 180]", "baseline = \"--network rm1.1 --weights " + weights + "\"\n"),
      Contains(HasSubstr(why)));
}

TEST(Methods, TakeAsManyConfigurationsAsAnFRaceCanTest) {
  for (const char* slow : {"first_test = 25\n", "mu = 40\n", "each_test = 5\nfirst_test = 20\n"})
    EXPECT_EQ(complaint_about("method = \"vanilla\"\n", slow), "read") << slow;
  EXPECT_EQ(complaint_about("method = \"vanilla\"\n", "min_experiments = 500\n"), "read");
}

TEST(Methods, SayWhyAnFRaceIsTooSmallOrTooLarge) {
  EXPECT_THAT(complaint_about("method = \"vanilla\"\n[method.f-race]\nconfigurations = 1\n"),
              HasSubstr("`configurations` must be 0 (automatic) or at least 2, not 1"));
  const std::string large =
      complaint_about("method = \"vanilla\"\n[method.f-race]\nconfigurations = 50000\n");
  EXPECT_THAT(large, HasSubstr("`configurations` is 50000"));
  EXPECT_THAT(large, HasSubstr("at least 300000"));
  EXPECT_THAT(large, Not(HasSubstr("nb_configurations")));
}

}  // namespace
}  // namespace swarmsmith
