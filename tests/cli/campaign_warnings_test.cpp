#include "cli/run/campaign_warnings.h"

#include "coordinator/campaign/campaign_file.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

Campaign campaign_of(const std::string& method, const std::string& rest = "") {
  const auto campaign =
      parse_campaign("format = 1\n[[mission]]\nname = \"aggregation\"\n[[method]]\nname = \"m\"\n" +
                         method + "[race]\nmax_experiments = 2000\n" + rest,
                     "x.toml");
  EXPECT_TRUE(campaign.has_value());
  return *campaign;
}

constexpr const char* kOutside =
    "mission aggregation: the robot's ground sensor at [0.05, 0] is outside of its body";

TEST(CampaignWarnings, ThereAreNoneForWhatWorks) {
  EXPECT_THAT(warnings_about(campaign_of("")), IsEmpty());
  EXPECT_THAT(warnings_about(campaign_of("flavour = \"watermelon-argos3\"\n",
                                         "[simulator]\nprofile = \"argos3\"\n")),
              IsEmpty());
}

TEST(CampaignWarnings, NameSensorsThatSeeLessOrMoreFarThanTheFlavourReckonsWith) {
  Campaign campaign = campaign_of("");
  campaign.profile.proximity.range_m = 0.3;
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("method \"m\": flavour watermelon takes obstacles into account up to 0.4 "
                          "m, but the proximity sensors of profile rvr see up to 0.3 m; obstacles "
                          "in between are never seen"));
  campaign.profile.proximity.range_m = 2;
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre(HasSubstr("see up to 2 m; what they see beyond that is ignored")));
}

TEST(CampaignWarnings, NameMissionsInTheDarkForModulesThatWantLight) {
  Campaign campaign = campaign_of("flavour = \"chocolate\"\n");
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("method \"m\": mission aggregation has no light, so that phototaxis and "
                          "anti_phototaxis only avoid obstacles there"));
  campaign.missions[0].mission.arena.lights.push_back({});
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
  EXPECT_THAT(warnings_about(campaign_of("flavour = \"chocolate\"\n"
                                         "behaviours = [\"stop\", \"anti_phototaxis\"]\n")),
              ElementsAre(HasSubstr("so that anti_phototaxis only avoids obstacles")));
  EXPECT_THAT(warnings_about(campaign_of("flavour = \"chocolate\"\n"
                                         "behaviours = [\"stop\", \"exploration\"]\n")),
              IsEmpty());
  // A network has no modules.
  EXPECT_THAT(warnings_about(campaign_of("flavour = \"chocolate\"\narchitecture = \"network\"\n")),
              IsEmpty());
}

TEST(CampaignWarnings, NameMissionsThatScoreObjectsWithoutHavingAny) {
  Campaign campaign = campaign_of("");
  Mission& mission = campaign.missions[0].mission;
  const auto warned = ElementsAre(
      "mission aggregation: its score is about movable objects, but its arena has none");
  mission.rule = ObjectsOn{};
  EXPECT_THAT(warnings_about(campaign), warned);
  Formula formula;
  mission.rule = formula;
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
  formula.of = "objects";
  mission.rule = formula;
  EXPECT_THAT(warnings_about(campaign), warned);
  mission.arena.objects.push_back({.outline = CircleOutline{0.1}, .start = {}});
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
}

TEST(CampaignWarnings, SayWhatARobotOfAnotherShapeKeepsOfTheRvr) {
  Campaign campaign = campaign_of("");
  campaign.missions[0].mission.robot.body.outline = CircleOutline{0.035};
  EXPECT_THAT(
      warnings_about(campaign),
      ElementsAre("mission aggregation: its robot has a shape of its own; everything else "
                  "is that of the RVR: 2 kg, a drive of 1.5 N, treads 0.147 m apart, the ground "
                  "sensor 0.05 m ahead of the centre, a height of 0.114 m, neighbours up "
                  "to 0.75 m",
                  kOutside));
  campaign.missions[0].mission.robot.body.outline = BoxOutline{0.3, 0.2};
  EXPECT_THAT(warnings_about(campaign), ElementsAre(HasSubstr("a shape of its own")));
  campaign.missions[0].mission.robot.body.outline =
      PolygonOutline{{{0.04, 0}, {-0.1, 0.1}, {-0.1, -0.1}}};
  EXPECT_THAT(warnings_about(campaign), ElementsAre(HasSubstr("a shape of its own"), kOutside));
}

TEST(CampaignWarnings, NameGroundPointsOutsideOfAnyRobotsBody) {
  Campaign campaign = campaign_of("");
  Robot& robot = campaign.missions[0].mission.robot;
  robot.body.mass_kg = 1;
  robot.ground.places = {{0.1, 0}, {0, 0.15}, {0.2, -0.1}};
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("mission aggregation: the robot's ground sensor at [0, 0.15] is outside "
                          "of its body",
                          HasSubstr("at [0.2, -0.1]")));
  robot.body.outline = CircleOutline{0.3};
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
}

TEST(CampaignWarnings, NameFlavoursThatDriveFasterThanTheRobotCan) {
  Campaign campaign = campaign_of("");
  campaign.missions[0].mission.robot.drive.max_speed_mps = 0.2;
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("method \"m\": flavour watermelon drives at 0.3 m/s; the robot of "
                          "mission aggregation reaches 0.2 m/s, and drives at that"));
}

TEST(CampaignWarnings, NameWallsThatAreLowerThanTheRaysThatMeetThem) {
  Campaign campaign = campaign_of("");
  Mission& mission = campaign.missions[0].mission;
  mission.arena.wall_height_m = mission.robot.proximity.height_m;
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
  mission.robot.proximity.height_m = 0.1;
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("mission aggregation: the robot's proximity sensors are 0.1 m high, its "
                          "walls 0.032 m; simulated rays hit walls of any height"));
}

TEST(CampaignWarnings, NameModulesThatLookForNeighboursOfARobotThatSeesNone) {
  const std::string modules =
      "behaviours = [\"stop\", \"repulsion\"]\nconditions = [\"gray_floor\", "
      "\"inverted_neighbour_count\"]\n";
  Campaign campaign = campaign_of(modules);
  campaign.missions[0].mission.robot.neighbours.range_m = 0;
  EXPECT_THAT(warnings_about(campaign),
              ElementsAre("method \"m\": the robot of mission aggregation never sees a neighbour, "
                          "because `neighbours.range` is 0 m, and the centres of two robots are at "
                          "least 0.286 m apart; these look for neighbours: repulsion, "
                          "inverted_neighbour_count"));
  campaign.missions[0].mission.robot.neighbours.range_m = 0.29;
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
  campaign.missions[0].mission.robot.neighbours.range_m = 0.28;
  EXPECT_THAT(warnings_about(campaign), ElementsAre(HasSubstr("`neighbours.range` is 0.28 m")));
  campaign.methods[0].behaviours = {"stop"};
  campaign.methods[0].conditions = {"gray_floor"};
  EXPECT_THAT(warnings_about(campaign), IsEmpty());
  campaign.methods[0].architecture = Architecture::Network;
  EXPECT_THAT(warnings_about(campaign), ElementsAre(HasSubstr("for neighbours: networks")));
}

}  // namespace
}  // namespace swarmsmith::cli
