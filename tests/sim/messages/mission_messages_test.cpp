#include "sim/messages/mission_messages.h"

#include <gtest/gtest.h>
#include <functional>
#include <limits>

#include "tests/sim/random_mission.h"

namespace swarmsmith {
namespace {

pb::Mission message_of(const Mission& mission) {
  pb::Mission message;
  to_message(mission, message);
  return message;
}

Mission some_mission() {
  Mission mission;
  mission.name = "odd";
  mission.arena = regular_dodecagon(4.91);
  mission.arena.floor = {1, 2, 255};
  mission.arena.patches = {{.shape = Disc{{0.1, -0.2}, 0.3}, .color = {255, 0, 7}},
                           {.shape = Rectangle{{-1e-300, 1.0 / 3}, 0.5, 0.25}, .color = {}}};
  mission.shuffled.places = {{{0.5, 0.5}, 0.1, 0.2}};
  mission.shuffled.shares = {{{9, 8, 7}, 3}};
  mission.robots = 20;
  mission.cycles = 77;
  mission.placement = PlaceInDisc{.centre = {}, .radius_m = 0.7};
  mission.rule = ColorReward{{{{1, 2, 3}, -1.5}, {{3, 2, 1}, 2}}};
  return mission;
}

TEST(MissionMessages, GiveBackTheBuiltInMissions) {
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Expected<Mission> mission = built_in_mission(name);
    ASSERT_TRUE(mission) << name;
    EXPECT_EQ(from_message(message_of(*mission)), *mission) << name;
  }
}

TEST(MissionMessages, GiveBackEveryFieldAndRule) {
  Mission mission = some_mission();
  EXPECT_EQ(from_message(message_of(mission)), mission);
  mission.rule = RobotsOn{{4, 5, 6}};
  EXPECT_EQ(from_message(message_of(mission)), mission);
  mission.rule = Coverage{7, 1.25};
  EXPECT_EQ(from_message(message_of(mission)), mission);
}

TEST(MissionMessages, GiveBackMissionsWithEverythingBitForBit) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Mission mission = random_mission(seed);
    EXPECT_EQ(from_message(message_of(mission)), mission) << seed;
  }
}

TEST(MissionMessages, SayWhatIsWrongAndWhere) {
  const auto complaint = [](const std::function<void(pb::Mission&)>& spoil) {
    pb::Mission message = message_of(some_mission());
    spoil(message);
    const Expected<Mission> mission = from_message(message);
    return mission ? "" : mission.error().where;
  };
  EXPECT_EQ(complaint([](auto& m) { m.mutable_arena()->mutable_floor()->set_g(256); }),
            "arena.floor");
  EXPECT_EQ(complaint([](auto& m) { m.mutable_arena()->mutable_patches(0)->clear_disc(); }),
            "arena.patches");
  EXPECT_EQ(complaint([](auto& m) {
              m.mutable_arena()->mutable_walls(0)->mutable_to()->set_x_m(
                  std::numeric_limits<double>::quiet_NaN());
            }),
            "arena.walls.to");
  EXPECT_EQ(complaint([](auto& m) { m.mutable_arena()->mutable_walls()->DeleteSubrange(2, 10); }),
            "arena.walls");
  EXPECT_EQ(complaint([](auto& m) { m.clear_rule(); }), "rule");
  EXPECT_EQ(complaint([](auto& m) { m.clear_placement(); }), "placement");
  EXPECT_EQ(complaint([](auto& m) { m.clear_body(); }), "body");
  EXPECT_EQ(complaint([](auto& m) { m.mutable_body()->set_circle_radius_m(0); }), "body.radius");
  EXPECT_EQ(complaint([](auto& m) { m.mutable_body()->mutable_polygon(); }), "body.corners");
  EXPECT_EQ(complaint([](auto& m) {
              m.mutable_arena()->mutable_patches(0)->mutable_image()->set_png("no");
            }),
            "arena.patches.image");
  EXPECT_EQ(complaint([](auto& m) { m.mutable_arena()->add_objects()->set_mass_kg(-1); }),
            "arena.objects");
  EXPECT_EQ(complaint([](auto& m) { m.set_robots(0); }), "robots");
  EXPECT_EQ(complaint([](auto& m) { m.set_cycles(2'000'000); }), "cycles");
}

}  // namespace
}  // namespace swarmsmith
