#include "sim/mission/instance_csv.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

const char* const kStarts =
    "seed,robot,x,y,theta\n"
    "7,0,-0.5,0.25,3\n"
    "7,1,0.5,0,-1.5\n"
    "7,2,0,-0.5,0\n";

std::string starts_error(std::string_view text) {
  const auto starts = parse_starts_csv(text);
  return starts ? "" : to_string(starts.error());
}

std::string patches_error(std::string_view text) {
  const auto patches = parse_patches_csv(text);
  return patches ? "" : to_string(patches.error());
}

TEST(StartsCsv, ReadsPosesBySeed) {
  const StartsBySeed starts = parse_starts_csv(kStarts).value();
  ASSERT_EQ(starts.size(), 1U);
  const std::vector<Pose> expected = {{-0.5, 0.25, 3}, {0.5, 0, -1.5}, {0, -0.5, 0}};
  EXPECT_EQ(starts.at(7), expected);
}

TEST(StartsCsv, AcceptsLineEndsOfBothKinds) {
  EXPECT_EQ(parse_starts_csv("seed,robot,x,y,theta\r\n1,0,0,0,0\r\n").value(),
            parse_starts_csv("seed,robot,x,y,theta\n1,0,0,0,0").value());
}

TEST(StartsCsv, ErrorsNameTheLine) {
  EXPECT_EQ(starts_error(""), "1: there is no column `seed`; needed are: seed, robot, x, y, theta");
  EXPECT_EQ(starts_error("seed,x,y\n"),
            "1: there is no column `robot`; needed are: seed, robot, x, y, theta");
  const std::string header = "seed,robot,x,y,theta\n";
  EXPECT_EQ(starts_error(header + "1,0,0,0\n"), "2: expected 5 cells as in the header, found 4");
  EXPECT_EQ(starts_error(header + "1,0,0,0,0\n1,2,0,0,0\n"),
            "3: column robot must be robot 1 of this seed, not `2`");
  EXPECT_EQ(starts_error(header + "1,0,0,0,0\n1,0,0,0,0\n"),
            "3: column robot must be robot 1 of this seed, not `0`");
  EXPECT_EQ(starts_error(header + "-1,0,0,0,0\n1,1,0,0,0\n"),
            "2: column seed must be a seed from 1 to 2147483647, not `-1`");
  EXPECT_EQ(starts_error("seed,robot,x,y,x,theta\n"), "1: the column `x` appears twice");
  EXPECT_EQ(starts_error("who,who,seed,robot,x,y,theta\n"), "") << "columns that are left out";
  EXPECT_EQ(starts_error(header + "x,0,0,0,0\n"), "2: column seed must be an integer, not `x`");
  EXPECT_EQ(starts_error(header + "1,0,0.1m,0,0\n"), "2: column x must be a number, not `0.1m`");
  EXPECT_EQ(starts_error(header + "1,0,0,inf,0\n"),
            "2: column y must be a finite number, not `inf`");
  EXPECT_EQ(starts_error(header + "1,0,0,0, 0\n"), "2: column theta must be a number, not ` 0`");
  EXPECT_EQ(starts_error(header + "1,0,0,0,1000.5\n"),
            "2: column theta must be an angle in radians, from -1000 to 1000, not `1000.5`");
}

TEST(StartsCsv, TakesColumnsInAnyOrderAndLeavesOthersOut) {
  EXPECT_EQ(parse_starts_csv("y,x,who,theta,robot,seed\n2,1,me,0.5,0,7\n\n").value(),
            parse_starts_csv("seed,robot,x,y,theta\n7,0,1,2,0.5\n").value());
}

TEST(PatchesCsv, ReadsPatchesBySeed) {
  const PatchesBySeed patches =
      parse_patches_csv("seed,x,y,color\n1,0.75,-0.25,yellow\n1,0.75,0.25,red\n2,0.25,0.25,blue\n")
          .value();
  ASSERT_EQ(patches.size(), 2U);
  EXPECT_EQ(patches.at(1)[0], (PatchPlacement{{0.75, -0.25}, {255, 255, 0}}));
  EXPECT_EQ(patches.at(2)[0], (PatchPlacement{{0.25, 0.25}, {0, 0, 255}}));
}

TEST(PatchesCsv, ErrorsNameTheLine) {
  EXPECT_EQ(patches_error("seed,x,y,colour\n"),
            "1: there is no column `color`; needed are: seed, x, y, color");
  EXPECT_EQ(patches_error("seed,x,y,color,seed\n"), "1: the column `seed` appears twice");
  EXPECT_EQ(patches_error("seed,x,y,color\n0,0,0,red\n"),
            "2: column seed must be a seed from 1 to 2147483647, not `0`");
  EXPECT_EQ(patches_error("seed,x,y,color\n1,0,0,pink\n"),
            "2: column color must be the name of a colour, or #rrggbb, not `pink`");
}

/// What was drawn reads back to the same instance, also colours without a name.
TEST(InstanceTables, ReadBackToTheSameBits) {
  Mission mission = built_in_mission("color_selection").value();
  mission.shuffled.shares.front().color = {1, 2, 254};
  std::map<std::int64_t, Instance> drawn;
  for (const std::int64_t seed : {1, 7, 2147483647})
    drawn.emplace(seed, instance_of(mission, seed).value());
  ExplicitInstances given;
  given.starts = parse_starts_csv(starts_csv(drawn)).value();
  given.patches = parse_patches_csv(patches_csv(drawn)).value();
  for (const auto& [seed, instance] : drawn)
    EXPECT_EQ(instance_of(mission, seed, given).value(), instance);
}

class ExplicitInstance : public ::testing::Test {
 protected:
  std::string error_of(std::int64_t seed) {
    const auto instance = instance_of(mission, seed, given);
    return instance ? "" : to_string(instance.error());
  }

  Mission mission = built_in_mission("color_selection").value();
  ExplicitInstances given{.starts = parse_starts_csv(kStarts).value(), .patches = {}};
};

TEST_F(ExplicitInstance, TakesWhatIsGivenAndDrawsTheRest) {
  const Instance instance = instance_of(mission, 7, given).value();
  EXPECT_EQ(instance.starts, given.starts->at(7));
  EXPECT_EQ(instance.patches, instance_of(mission, 7).value().patches);
  EXPECT_EQ(instance_of(mission, 7, ExplicitInstances{}).value(), instance_of(mission, 7).value());
}

TEST_F(ExplicitInstance, PatchesTakeTheSizeOfTheMissionsPlaces) {
  mission.shuffled.shares = {ShuffledPatches::Share{{255, 0, 0}, 1}};
  given.patches = parse_patches_csv("seed,x,y,color\n7,0.25,-0.75,red\n").value();
  const Instance instance = instance_of(mission, 7, given).value();
  ASSERT_EQ(instance.patches.size(), 1U);
  EXPECT_EQ(instance.patches[0], (Patch{Rectangle{{0.25, -0.75}, 0.30, 0.30}, {255, 0, 0}}));
  const Mission aggregation = built_in_mission("aggregation").value();
  EXPECT_TRUE(instance_of(aggregation, 7, given).value().patches.empty());
}

TEST_F(ExplicitInstance, GivenStartsReplaceThePlacesOfTheMission) {
  mission.placement = PlaceAt{{{0.5, 0.5, 0}, {-0.5, 0.5, 0}, {0, -0.5, 0}}};
  EXPECT_EQ(error_of(7), "");
  EXPECT_EQ(instance_of(mission, 7, given).value().starts, given.starts->at(7));
}

TEST_F(ExplicitInstance, ASeedWithoutARowIsAnError) {
  EXPECT_EQ(error_of(8), "the starts have no row for seed 8");
  given.patches = PatchesBySeed{};
  EXPECT_EQ(error_of(7), "the patches have no row for seed 7");
}

TEST_F(ExplicitInstance, AnotherNumberOfRobotsIsAnError) {
  mission.robots = 4;
  EXPECT_EQ(error_of(7), "starts, seed 7: the mission has 4 robots, the file 3");
}

TEST_F(ExplicitInstance, AStartBehindAWallIsAnError) {
  given.starts->at(7)[1].x = 1.3;
  EXPECT_EQ(error_of(7), "starts, seed 7: robot 1 is outside the arena");
}

TEST_F(ExplicitInstance, APatchBesideThePlacesOrASecondOneIsAnError) {
  given.patches = parse_patches_csv("seed,x,y,color\n7,0.3,-0.75,red\n").value();
  EXPECT_NE(error_of(7).find("there is no free place for a patch at (0.300000"), std::string::npos);
  given.patches = parse_patches_csv("seed,x,y,color\n7,0.25,0.25,red\n7,0.25,0.25,green\n").value();
  EXPECT_NE(error_of(7).find("there is no free place"), std::string::npos);
}

TEST_F(ExplicitInstance, OtherNumbersOfColorsThanTheMissionsAreAnError) {
  mission.shuffled.shares = {{{255, 0, 0}, 2}, {{0, 255, 0}, 1}};
  const std::string red = "seed,x,y,color\n7,0.25,-0.75,red\n";
  const auto error_with = [&](const std::string& rows) {
    given.patches = parse_patches_csv(red + rows).value();
    return error_of(7);
  };
  EXPECT_EQ(error_with("7,0.25,0.25,red\n7,0.25,0.75,green\n"), "");
  EXPECT_EQ(error_with("7,0.25,0.25,red\n"),
            "patches, seed 7: the mission has 1 green patch, the file 0");
  EXPECT_EQ(
      error_with("7,0.25,0.25,blue\n7,0.25,0.75,green\n"),
      "patches, seed 7: the mission has 2 red patches, the file 1; 0 blue patches, the file 1");
}

TEST_F(ExplicitInstance, SaysWhetherRobotsOverlap) {
  const auto overlaps = [&] {
    return has_overlaps(mission, instance_of(mission, 7, given).value());
  };
  EXPECT_FALSE(overlaps());
  given.starts->at(7)[1].x = -0.4;
  given.starts->at(7)[1].y = 0.25;
  EXPECT_TRUE(overlaps()) << "the other robot";
  given.starts->at(7)[1] = {1.2, 0, 0};
  EXPECT_TRUE(overlaps()) << "a wall";
  given.starts->at(7)[1] = {0.5, 0, 0};
  mission.arena.obstacles.push_back({.outline = CircleOutline{0.1}, .pose = {0.5, 0.1, 0}});
  EXPECT_TRUE(overlaps()) << "an obstacle";
}

}  // namespace
}  // namespace swarmsmith
