#include "coordinator/campaign/campaign_text.h"

#include <set>

#include "coordinator/campaign/campaign_rows.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/sim/every_noise.h"
#include "tests/sim/random_mission.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using testing::Pair;
using testing::SizeIs;

const FileText kRich{
    .campaign = "seed = 9\nrepetitions = 2\n",
    .mission =
        "name = \"color_selection\"\n[[mission]]\n"
        "name = \"grid_exploration\"\nduration = \"12.3 s\"\n[[mission]]\n"
        "name = \"shelter\"\narena = { area = 4.91, floor = \"#010203\", "
        "spots = [ { shape = \"circle\", x = 0.1, y = 0, diameter = 0.7, "
        "color = \"black\" } ] }\n"
        "score = { kind = \"robots_on\", color = \"black\" }\n",
    .method =
        "name = \"a\"\n[[method]]\nname = \"b\"\n"
        "flavour = \"watermelon-argos3\"\nmax_states = 3\nturn_clock = \"seconds\"\n"
        "parameters.neighbour_count.eta = { real = [0.25, 10] }\n",
    .race = "max_experiments = 5000\nmin_experiments = 100\nconfidence = 0.9\n"};

TEST(NormalisedText, ReadsBackToTheSameCampaign) {
  const Campaign campaign = parsed(kRich.text());
  const Campaign again = parsed(normalised_text(campaign));
  EXPECT_EQ(again.name, campaign.name);
  EXPECT_EQ(again.seed, campaign.seed);
  EXPECT_EQ(again.repetitions, campaign.repetitions);
  EXPECT_EQ(again.missions, campaign.missions);
  EXPECT_EQ(again.methods, campaign.methods);
  EXPECT_EQ(again.profile, campaign.profile);
  EXPECT_EQ(again.digits, campaign.digits);
  EXPECT_EQ(again.race.min_experiments, campaign.race.min_experiments);
  EXPECT_EQ(normalised_text(again), normalised_text(campaign));
  EXPECT_EQ(campaign_digest(again), campaign_digest(campaign));
}

TEST(NormalisedText, OfEachBuiltInMissionReadsBackToIt) {
  for (const std::string name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Campaign campaign = parsed(FileText{.mission = "name = \"" + name + "\"\n"}.text());
    const std::string text = normalised_text(campaign);
    EXPECT_EQ(parsed(text).missions, campaign.missions) << text;
  }
}

TEST(NormalisedText, OfMissionsAndProfilesWithEverythingReadsBackToThem) {
  Campaign campaign = parsed(FileText{}.text());
  campaign.missions.clear();
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    campaign.missions.push_back({{.mission = random_mission(seed)}, {}});
  campaign.profile = every_noise();
  const Campaign again = parsed(normalised_text(campaign));
  EXPECT_EQ(again.missions, campaign.missions);
  EXPECT_EQ(again.profile, campaign.profile);
  EXPECT_EQ(campaign_digest(again), campaign_digest(campaign));
}

std::string digest_of(const FileText& file) {
  return campaign_digest(parsed(file.text()));
}

TEST(CampaignDigest, DoesNotCoverStoreNameWorkersAndAddresses) {
  const FileText other{.campaign = "name = \"other\"\nstore = \"/tmp/other.db\"\n",
                       .rest =
                           "[workers]\nlocal = 7\nbind = \"127.0.0.1:7777\"\n"
                           "timeout = \"9 s\"\nretries = 0\non_failure = \"stop\"\n"
                           "[dashboard]\nbind = \"127.0.0.1:1\"\n"};
  EXPECT_EQ(digest_of(other), digest_of({}));
}

TEST(CampaignDigest, DoesNotCoverCommentsOrderOfKeysAndSpelling) {
  const std::string text =
      "# a comment\nformat = 1\n[race] # budget\nmax_experiments = 2000\nconfidence = 0.95\n"
      "[[method]]\nname = \"watermelon\"\nmax_states = 4\n"
      "[[mission]]\nrobots = 3\nname = \"aggregation\"\nduration = \"2 min\"\n[campaign]\n";
  EXPECT_EQ(campaign_digest(parsed(text)), digest_of({}));
}

TEST(CampaignDigest, CoversEverythingThatDecides) {
  const std::vector<FileText> files = {
      {},
      {.campaign = "seed = 2\n"},
      {.campaign = "repetitions = 2\n"},
      {.mission = "name = \"grid_exploration\"\n"},
      {.mission = "name = \"other\"\npreset = \"aggregation\"\n"},
      {.mission = "name = \"aggregation\"\nrobots = 2\n"},
      {.mission = "name = \"aggregation\"\nduration = \"119.9 s\"\n"},
      {.mission = "name = \"aggregation\"\narena = { area = 4.9 }\n"},
      {.mission = "name = \"aggregation\"\narena = { floor = \"white\" }\n"},
      {.mission = "name = \"aggregation\"\nscore = { kind = \"coverage\" }\n"},
      {.mission = "name = \"aggregation\"\ninstances = { test = { count = 7 } }\n"},
      {.method = "name = \"x\"\n"},
      {.method = "name = \"watermelon\"\nflavour = \"watermelon-argos3\"\n"},
      {.method = "name = \"watermelon\"\nflavour = \"chocolate\"\n"},
      {.method = "name = \"watermelon\"\nturn_clock = \"seconds\"\n"},
      {.method = "name = \"watermelon\"\nmax_states = 3\n"},
      {.method = "name = \"watermelon\"\nbehaviours = [\"stop\", \"exploration\"]\n"},
      {.method = "name = \"watermelon\"\nparameters.exploration.tau = { int = [1, 50] }\n"},
      {.race = "max_experiments = 2001\n"},
      {.race = "max_experiments = 2000\nconfidence = 0.96\n"},
      {.race = "max_experiments = 2000\nsoft_restart = false\n"},
      {.race = "max_experiments = 2000\ndigits = 3\n"},
      {.rest = "[simulator]\nprofile = \"argos3\"\n"},
      {.rest = "[simulator.profile]\nname = \"rvr\"\nbase = \"rvr\"\nlidar.half_width = 0.02\n"},
      {.rest = "[simulator.profile]\nname = \"rvr\"\nbase = \"rvr\"\ntiming.jitter = 0.01\n"},
      {.mission = "name = \"aggregation\"\nrobot = { shape = \"circle\", diameter = 0.3 }\n"},
      {.mission = "name = \"aggregation\"\narena = { shape = \"square\", side = 3 }\n"},
      {.mission = "name = \"aggregation\"\narena = { wall_height = 0.3 }\n"},
      {.mission = "name = \"aggregation\"\narena = { lights = [ { x = 0, y = 0 } ] }\n"},
      {.mission = "name = \"aggregation\"\narena = { obstacles = [ { shape = \"circle\", x = 0, "
                  "y = 0, diameter = 0.3 } ] }\n"},
      {.mission = "name = \"aggregation\"\narena = { objects = [ { shape = \"circle\", x = 0, y "
                  "= 0, diameter = 0.3, mass = 1, friction = 1 } ] }\n"},
      {.mission = "name = \"aggregation\"\ninstances = { training = { radius = 1 } }\n"},
      {.mission = "name = \"aggregation\"\ninstances.training.placement = \"anywhere\"\n"},
  };
  std::set<std::string> digests;
  for (const FileText& file : files)
    digests.insert(digest_of(file));
  EXPECT_THAT(digests, SizeIs(files.size()));
}

TEST(Deciding, ReadsLikeTheFile) {
  const Deciding entries = deciding(parsed(FileText{}.text()));
  EXPECT_THAT(entries, Contains(Pair("campaign.seed", "1")));
  EXPECT_THAT(entries, Contains(Pair("mission.aggregation.duration", "\"120 s\"")));
  EXPECT_THAT(entries, Contains(Pair("method.watermelon.turn_clock", "\"cycles\"")));
  EXPECT_THAT(entries, Contains(Pair("race.max_experiments", "2000")));
  EXPECT_THAT(entries, Contains(Pair("engine.version", testing::_)));
  EXPECT_EQ(entries.back().first, "race.version");
}

TEST(DesignRows, GoByMissionThenMethodThenRepetition) {
  const Campaign campaign = parsed(
      FileText{.campaign = "repetitions = 2\n",
               .mission = "name = \"aggregation\"\n[[mission]]\nname = \"color_selection\"\n",
               .method = "name = \"b\"\n[[method]]\nname = \"a\"\n"}
          .text());
  std::vector<std::string> designs;
  for (const DesignRow& row : design_rows(campaign)) {
    designs.push_back(to_string(row.id) + " " + row.mission + " " + row.method + " " +
                      std::to_string(row.repetition));
    EXPECT_GT(row.seed, 0);
    EXPECT_EQ(row.budget, 2000);
  }
  EXPECT_THAT(designs,
              ElementsAre("d1 aggregation b 1", "d2 aggregation b 2", "d3 aggregation a 1",
                          "d4 aggregation a 2", "d5 color_selection b 1", "d6 color_selection b 2",
                          "d7 color_selection a 1", "d8 color_selection a 2"));
}

TEST(DesignRows, GiveEveryDesignASeedThatFollowsFromTheCampaigns) {
  Campaign campaign = parsed(FileText{.campaign = "repetitions = 3\n"}.text());
  std::set<std::int64_t> seeds;
  for (const DesignRow& row : design_rows(campaign))
    seeds.insert(row.seed);
  campaign.seed = 2;
  for (const DesignRow& row : design_rows(campaign))
    seeds.insert(row.seed);
  EXPECT_THAT(seeds, SizeIs(6));
}

TEST(CampaignRow, HoldsTextAndKeysOfTheCampaign) {
  const Campaign campaign = parsed(FileText{}.text());
  const CampaignRow row = campaign_row(campaign);
  EXPECT_EQ(row.digest, campaign_digest(campaign));
  EXPECT_EQ(row.file, normalised_text(campaign));
  EXPECT_THAT(row.deciding, StartsWith(R"({"campaign.seed":"1",)"));
  EXPECT_THAT(row.deciding, HasSubstr(R"("mission.aggregation.duration":"\"120 s\"")"));
}

// irace's files may be in any encoding, and readers of JSON refuse what is not UTF-8.
TEST(CampaignRow, IsJsonWhereAProgramsParametersAreNotUtf8) {
  Campaign campaign = parsed(FileText{}.text());
  campaign.methods.front().parameters = "a \"--a\" c (caf\xe9, b)\n";
  EXPECT_THAT(campaign_row(campaign).deciding, HasSubstr("(caf\xef\xbf\xbd, b)"));
}

}  // namespace
}  // namespace swarmsmith
