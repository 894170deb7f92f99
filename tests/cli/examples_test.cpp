#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/mission/polygon.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

Campaign example(const std::string& name) {
  const auto file = std::filesystem::path(SWARMSMITH_SOURCE_DIR) / "examples" / (name + ".toml");
  return value_of(read_campaign(file));
}

TEST(Examples, OfEachMissionRunAsTheyAre) {
  for (const std::string name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Campaign campaign = example(name);
    ASSERT_EQ(campaign.missions.size(), 1U);
    EXPECT_EQ(campaign.missions[0].mission, *built_in_mission(name));
  }
}

TEST(Examples, OfTheThesisAreThirtyDesignsOfAHundredThousandExperiments) {
  const Campaign campaign = example("thesis");
  EXPECT_EQ(design_rows(campaign).size(), 30U);
  EXPECT_EQ(campaign.race.max_experiments, 100'000);
}

TEST(Examples, OfAMissionOfOnesOwnUseEveryKindOfScore) {
  const Campaign campaign = example("own_missions");
  EXPECT_EQ(campaign.missions.size(), 3U);
}

/// A mission of examples/missions, which three machines have run.
Mission example_mission(const std::string& name) {
  const auto file =
      std::filesystem::path(SWARMSMITH_SOURCE_DIR) / "examples" / "missions" / (name + ".toml");
  auto entry = read_mission_file(file);
  if (!entry) {
    ADD_FAILURE() << to_string(entry.error().front());
    return {};
  }
  const Ran ran = run_well({"evaluate", kExploreText, "--flavour", "watermelon", "--mission",
                            file.string(), "--seeds", "1-3"});
  return std::move(entry->mission);
}

TEST(Examples, OfPhototaxisHaveALightBeyondTheWall) {
  const Mission mission = example_mission("phototaxis");
  ASSERT_EQ(mission.arena.lights.size(), 1U);
  EXPECT_FALSE(
      is_inside(mission.arena, {mission.arena.lights[0].x_m, mission.arena.lights[0].y_m}));
}

TEST(Examples, OfForagingHaveANestTwoSourcesAndALight) {
  const Mission mission = example_mission("foraging");
  EXPECT_EQ(mission.rule, ScoreRule(Foraging{}));
  EXPECT_EQ(floor_at(mission.arena, {0, -0.8}), (Rgb{255, 255, 255}));
  EXPECT_EQ(floor_at(mission.arena, {0.65, 0.4}), (Rgb{0, 0, 0}));
  EXPECT_EQ(floor_at(mission.arena, {-0.65, 0.4}), (Rgb{0, 0, 0}));
  EXPECT_EQ(mission.arena.lights.size(), 1U);
}

/// What the formula means, worked out from the trajectory.
TEST(Examples, OfDispersionAreScoredByTheirFormula) {
  const Mission mission = example_mission("dispersion");
  const Machine straight = parse_machine("--nstates 1 --s0 0 --rwm0 1", watermelon()).value();
  const Profile profile = built_in_profile("rvr").value();
  const Instance instance = instance_of(mission, 1).value();
  std::vector<std::vector<Pose>> instants;
  const auto keep = [&](const Snapshot& snapshot) {
    auto& poses = instants.emplace_back();
    for (const RobotRecord& robot : snapshot.robots)
      poses.push_back(robot.pose);
  };
  const double score =
      simulate({straight, watermelon(), profile, mission, instance, 1}, Recorder(keep)).score;
  double sum = 0;
  for (std::size_t cycle = 401; cycle <= 600; ++cycle) {
    for (std::size_t a = 0; a < 5; ++a) {
      double nearest = 1e9;
      for (std::size_t b = 0; b < 5; ++b) {
        if (a == b) continue;
        const Pose& p = instants[cycle][a];
        const Pose& q = instants[cycle][b];
        nearest = std::min(nearest, std::hypot(p.x - q.x, p.y - q.y));
      }
      sum += nearest / 5 / 200;
    }
  }
  EXPECT_NEAR(score, sum, 1e-9);
  EXPECT_GT(score, 0);
}

TEST(Examples, OfBoxPushingHaveABoxThatThreeRobotsMoveAndTwoDoNot) {
  constexpr double kPush_N = 1.5;  // of a robot: rvr-automode facts, section 2
  const Mission mission = example_mission("box_pushing");
  EXPECT_EQ(mission.robots, 3);
  ASSERT_EQ(mission.arena.objects.size(), 1U);
  EXPECT_GT(mission.arena.objects[0].friction_N, 2 * kPush_N);
  EXPECT_LT(mission.arena.objects[0].friction_N, 3 * kPush_N);
  // Straight on is enough, for three of them.
  const Machine straight = parse_machine("--nstates 1 --s0 0 --rwm0 1", watermelon()).value();
  const Profile profile = built_in_profile("argos3").value();
  Instance instance = instance_of(mission, 1).value();
  const auto score = [&] {
    return simulate({straight, watermelon(), profile, mission, instance, 1}).score;
  };
  EXPECT_EQ(score(), 1);
  instance.starts.pop_back();
  EXPECT_EQ(score(), 0);
}

TEST(Examples, OfAMazeHaveWallsThatAreNotConvexAndObstacles) {
  const Mission mission = example_mission("maze");
  EXPECT_FALSE(is_convex(corners_of(mission.arena)));
  EXPECT_EQ(mission.arena.obstacles.size(), 3U);
}

TEST(Examples, OfAnImageFloorHaveThePicturesColours) {
  const Mission mission = example_mission("image_floor");
  EXPECT_EQ(floor_at(mission.arena, {0, 0.75}), (Rgb{255, 255, 0}));
  EXPECT_EQ(floor_at(mission.arena, {0, 0.3}), (Rgb{127, 127, 127}));
}

}  // namespace
}  // namespace swarmsmith::cli
