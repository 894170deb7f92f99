#include <gtest/gtest.h>

#include <set>

#include "sim/mission/mission.h"

namespace swarmsmith {
namespace {

TEST(BuiltInMission, AnUnknownNameListsTheKnownOnes) {
  const Expected<Mission> mission = built_in_mission("foraging");
  ASSERT_FALSE(mission.has_value());
  EXPECT_EQ(mission.error().kind, ErrorKind::NotFound);
  EXPECT_EQ(mission.error().message,
            "there is no mission `foraging`; built in are: aggregation, grid_exploration, "
            "color_selection");
}

TEST(BuiltInMission, AllAreOfThreeRobotsAndTwoMinutesInTheArenaOfTheThesis) {
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Mission mission = built_in_mission(name).value();
    EXPECT_EQ(mission.name, name);
    EXPECT_EQ(mission.robots, 3);
    EXPECT_EQ(mission.cycles, 1200);
    EXPECT_EQ(mission.placement, Placement(PlaceInDisc{.centre = {}, .radius_m = 1.2}));
    EXPECT_EQ(mission.arena.walls, dodecagon_of_the_thesis().walls);
    EXPECT_EQ(mission.arena.floor, (Rgb{127, 127, 127}));
  }
}

TEST(BuiltInMission, AggregationHasABlackDiscOfDiameterOneMetre) {
  const Mission mission = built_in_mission("aggregation").value();
  EXPECT_EQ(floor_at(mission.arena, {0.3, 0.4}), (Rgb{0, 0, 0}));
  EXPECT_EQ(floor_at(mission.arena, {0.31, 0.4}), (Rgb{127, 127, 127}));
  EXPECT_TRUE(mission.shuffled.places.empty());
}

TEST(BuiltInMission, ColorSelectionHasTwelvePlacesThatDoNotOverlap) {
  const Mission mission = built_in_mission("color_selection").value();
  const auto& places = mission.shuffled.places;
  ASSERT_EQ(places.size(), 12U);
  std::set<std::pair<double, double>> centres;
  for (const Rectangle& place : places) {
    centres.insert({place.centre.x, place.centre.y});
    EXPECT_EQ(place.width_m, 0.30);
    EXPECT_EQ(place.height_m, 0.30);
  }
  EXPECT_EQ(centres.size(), 12U);
  EXPECT_EQ(centres.count({0.75, 0.75}), 0U);  // the corners stay free
  for (const auto& [x, y] : centres)
    EXPECT_EQ(centres.count({-x, -y}), 1U);
}

}  // namespace
}  // namespace swarmsmith
