#include <limits>

#include "coordinator/campaign/campaign_text.h"
#include "proto/scenario/scenario.h"
#include "sim/files/profile_file.h"
#include "sim/mission/score.h"
#include "sim/mission/trajectory.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"

// The kind `spread` of docs/missions.md, with nothing but its pair of files and its line.

namespace swarmsmith {
namespace {

FileText mission_with(const std::string& score) {
  return {.mission = "name = \"together\"\nscore = { " + score + " }\n"};
}

TEST(NewScore, IsInTheList) {
  EXPECT_THAT(score_kinds(), Contains("spread"));
  EXPECT_EQ(score_of_kind("spread"), ScoreRule(Spread{}));
  EXPECT_EQ(kind_of(Spread{}), "spread");
}

TEST(NewScore, IsReadFromACampaignFile) {
  const Campaign campaign =
      parsed(mission_with("kind = \"spread\", free = 0.6, at = \"sum\"").text());
  const ScoreRule wanted = Spread{.free_m = 0.6, .at = When::Sum};
  EXPECT_EQ(campaign.missions[0].mission.rule, wanted);
  const Campaign plain = parsed(mission_with("kind = \"spread\"").text());
  EXPECT_EQ(plain.missions[0].mission.rule, ScoreRule(Spread{}));
}

TEST(NewScore, IsStoredWholeAndReadsBack) {
  const Campaign campaign = parsed(mission_with("kind = \"spread\", free = 0.6").text());
  const std::string text = normalised_text(campaign);
  EXPECT_THAT(text, HasSubstr("kind = \"spread\"\nfree = 0.6\nat = \"end\"\n"));
  EXPECT_EQ(parsed(text).missions, campaign.missions);
  EXPECT_THAT(deciding(campaign), Contains(testing::Pair("mission.together.score.free", "0.6")));
}

TEST(NewScore, IsRefusedWithLineAndColumn) {
  const auto said = [](const std::string& score) { return complaints(mission_with(score).text()); };
  EXPECT_THAT(
      said("kind = \"spred\""),
      ElementsAre(HasSubstr("5:18: `kind` cannot be \"spred\" (did you mean \"spread\"?)")));
  EXPECT_THAT(said("kind = \"spread\", fre = 1"),
              ElementsAre(HasSubstr("5:28: [mission.score] has no key `fre` (did you mean "
                                    "\"free\"?)")));
  EXPECT_THAT(said("kind = \"spread\", free = -1"),
              ElementsAre(HasSubstr("5:35: `free` must be from 0 to 100, not -1")));
}

TEST(NewScore, GoesToAWorkerAndBack) {
  WorkerScenario scenario{.missions = {built_in_mission("aggregation").value()},
                          .profile = *built_in_profile("rvr")};
  scenario.missions[0].rule = Spread{.free_m = 1.0 / 3, .at = When::Sum};
  EXPECT_EQ(scenarios_from_bytes(to_bytes({scenario})), PoolScenario{scenario});
  scenario.missions[0].rule = Spread{.free_m = std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(scenarios_from_bytes(to_bytes({scenario})));
}

TEST(NewScore, ScoresATrajectory) {
  // Distances 0.5 and 1.5: greatest sides of the triangles 3-4-5 and 9-12-15.
  const Trajectory trajectory{
      .robots = 3,
      .poses = {{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.4, 0}, {0, 0, 0}, {0.9, 0, 0}, {0.9, 1.2, 0}}};
  Mission mission = built_in_mission("aggregation").value();
  mission.rule = Spread{.free_m = 0.25, .at = When::End};
  EXPECT_EQ(score_of(mission, Instance{}, trajectory), -1.25);
  mission.rule = Spread{.free_m = 0.25, .at = When::Sum};
  EXPECT_EQ(score_of(mission, Instance{}, trajectory), -1.5);
}

}  // namespace
}  // namespace swarmsmith
