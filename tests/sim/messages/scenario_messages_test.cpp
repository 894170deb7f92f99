#include "sim/messages/scenario_messages.h"

#include <gtest/gtest.h>

#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

WorkerScenario some_scenario() {
  return {.campaign_digest = "0123456789abcdef0123456789abcdef",
          .engine_version = 3,
          .missions = {*built_in_mission("aggregation"), *built_in_mission("color_selection")},
          .flavours = {"watermelon", "watermelon-argos3"},
          .profile = *built_in_profile("rvr")};
}

TEST(ScenarioMessages, GiveBackTheScenario) {
  WorkerScenario scenario = some_scenario();
  EXPECT_EQ(scenario_from_bytes(to_bytes(scenario)), scenario);
  scenario.profile.contacts = ContactModel::Box2d;
  EXPECT_EQ(scenario_from_bytes(to_bytes(scenario)), scenario);
}

TEST(ScenarioMessages, AreTheSameBytesForTheSameScenario) {
  EXPECT_EQ(to_bytes(some_scenario()), to_bytes(some_scenario()));
}

TEST(ScenarioMessages, SayWhichMissionIsWrong) {
  WorkerScenario scenario = some_scenario();
  scenario.missions[1].cycles = 0;
  const auto read = scenario_from_bytes(to_bytes(scenario));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "missions[1].cycles");
}

TEST(ScenarioMessages, RefuseBytesAndProfilesThatMakeNoSense) {
  EXPECT_FALSE(scenario_from_bytes("\xff\xff\xff"));
  WorkerScenario scenario = some_scenario();
  scenario.profile.proximity.sd_m = -1;
  EXPECT_FALSE(scenario_from_bytes(to_bytes(scenario)));
}

}  // namespace
}  // namespace swarmsmith
