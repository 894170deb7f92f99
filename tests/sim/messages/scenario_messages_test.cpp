#include "sim/messages/scenario_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "proto/key.h"
#include "proto/scenario.pb.h"
#include "sim/files/profile_file.h"
#include "sim/messages/profile_messages.h"
#include "tests/sim/every_noise.h"

namespace swarmsmith {
namespace {

WorkerScenario some_scenario() {
  return {.campaign_digest = "0123456789abcdef0123456789abcdef",
          .engine_version = 3,
          .missions = {*built_in_mission("aggregation"), *built_in_mission("color_selection")},
          .methods = {{.flavour = "watermelon"}, {"watermelon-argos3", TurnClock::Seconds}},
          .profile = *built_in_profile("rvr")};
}

Expected<WorkerScenario> read_back(const WorkerScenario& scenario) {
  Expected<PoolScenario> scenarios = scenarios_from_bytes(to_bytes({scenario}));
  if (!scenarios) return Unexpected(scenarios.error());
  EXPECT_EQ(scenarios->size(), 1U);
  return scenarios->front();
}

TEST(ScenarioMessages, GiveBackSeveralCampaignsAndNameTheFaultyOne) {
  WorkerScenario other = some_scenario();
  other.missions.pop_back();
  const PoolScenario both = {some_scenario(), other};
  EXPECT_EQ(scenarios_from_bytes(to_bytes(both)), both);
  other.missions[0].cycles = 0;
  EXPECT_EQ(scenarios_from_bytes(to_bytes({some_scenario(), other})).error().where,
            "campaigns[1].missions[0].cycles");
  EXPECT_EQ(scenarios_from_bytes("").error().where, "campaigns");
  EXPECT_FALSE(scenarios_from_bytes(to_bytes(PoolScenario(kMaxCampaigns + 1, other))));
}

TEST(ScenarioMessages, GiveBackTheScenario) {
  WorkerScenario scenario = some_scenario();
  EXPECT_EQ(read_back(scenario), scenario);
  scenario.profile = every_noise();
  EXPECT_EQ(read_back(scenario), scenario);
}

TEST(ScenarioMessages, RefuseAClockOfTurnsThatIsNotKnown) {
  pb::PoolScenario message;
  ASSERT_TRUE(message.ParseFromString(to_bytes({some_scenario()})));
  message.mutable_campaigns(0)->mutable_methods(1)->set_turn_clock(
      static_cast<pb::Method::TurnClock>(7));
  const auto read = scenarios_from_bytes(message.SerializeAsString());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "methods[1].turn_clock");
}

TEST(ScenarioMessages, GiveBackTheMethods) {
  EXPECT_EQ(read_back(some_scenario())->methods, some_scenario().methods);
}

TEST(ScenarioMessages, AreTheSameBytesForTheSameScenario) {
  EXPECT_EQ(to_bytes({some_scenario()}), to_bytes({some_scenario()}));
}

TEST(ScenarioMessages, SayWhichMissionIsWrong) {
  WorkerScenario scenario = some_scenario();
  scenario.missions[1].cycles = 0;
  const auto read = read_back(scenario);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "missions[1].cycles");
}

TEST(ScenarioMessages, RefuseBytesAndProfilesThatMakeNoSense) {
  EXPECT_FALSE(scenarios_from_bytes("\xff\xff\xff"));
  const auto complaint = [](const std::function<void(Profile&)>& spoil) {
    WorkerScenario scenario = some_scenario();
    spoil(scenario.profile);
    const auto read = read_back(scenario);
    return read ? "" : read.error().where;
  };
  EXPECT_EQ(complaint([](Profile&) {}), "");
  EXPECT_EQ(complaint([](Profile& p) { p.proximity.sd_m = -1; }), "profile.proximity.sd");
  EXPECT_EQ(complaint([](Profile& p) { p.neighbours.miss_rate = std::nan(""); }),
            "profile.neighbours.miss_rate");
  EXPECT_EQ(complaint([](Profile& p) { p.timing.delays = {{10, 0.5}}; }), "profile.timing.delays");
  EXPECT_EQ(complaint([](Profile& p) { p.timing.least_period = 2; }), "profile.timing.period");
  EXPECT_EQ(complaint([](Profile& p) { p.tracking.tag.y = 7; }), "profile.tracking.tag");
}

WorkerScenario with_programs() {
  WorkerScenario scenario{.campaign_digest = "d", .engine_version = 3};
  scenario.target = Target{.runner = "/r",
                           .launcher = "/l",
                           .command_line = "{seed}",
                           .evaluator = "/e",
                           .folder = "/f",
                           .retries = 2,
                           .timeout_s = 60,
                           .timeout_is_rejection = true,
                           .aclib = true,
                           .batch_mode = BatchMode::HtCondor,
                           .prints_time = true,
                           .min_measurable_time = 0.5,
                           .debug_level = 3};
  scenario.instances = {{{"a", "b c"}, {"t\xff"}}, {}};
  return scenario;
}

TEST(TargetMessages, GiveBackThePrograms) {
  EXPECT_EQ(read_back(with_programs()), with_programs());
}

TEST(TargetMessages, AreCheckedWhenTheyCome) {
  const auto complaint = [](const std::function<void(Target&)>& spoil) {
    WorkerScenario scenario = with_programs();
    spoil(*scenario.target);
    const auto read = read_back(scenario);
    return read ? "fine" : read.error().where;
  };
  EXPECT_EQ(complaint([](Target& t) { t.runner = "r"; }), "target.runner");
  EXPECT_EQ(complaint([](Target& t) { t.launcher = "l"; }), "target.launcher");
  EXPECT_EQ(complaint([](Target& t) { t.folder = ""; }), "target.folder");
  EXPECT_EQ(complaint([](Target& t) { t.command_line += '\0'; }), "target.command_line");
  EXPECT_EQ(complaint([](Target& t) { t.retries = -1; }), "target.retries");
  EXPECT_EQ(complaint([](Target& t) { t.timeout_s = -1; }), "target.timeout_s");
  EXPECT_EQ(complaint([](Target& t) { t.min_measurable_time = std::nan(""); }),
            "target.min_measurable_time");
  EXPECT_EQ(complaint([](Target& t) { t.debug_level = 4; }), "target.debug_level");
  EXPECT_EQ(complaint([](Target& t) { t.batch_mode = static_cast<BatchMode>(9); }),
            "target.batch_mode");
  EXPECT_EQ(complaint([](Target& t) { t.evaluator.clear(); }), "target.evaluator");
  WorkerScenario scenario = with_programs();
  scenario.instances[0].test[0] += '\0';
  EXPECT_EQ(read_back(scenario).error().where, "instances");
}

TEST(ProfileMessages, NeedEveryFieldAndNoOther) {
  pb::Profile message;
  to_message(every_noise(), message);
  EXPECT_EQ(from_message(message), every_noise());
  pb::Profile less = message;
  less.mutable_fields()->RemoveLast();
  EXPECT_FALSE(from_message(less));
  message.add_fields()->set_key("proximity.more");
  ASSERT_FALSE(from_message(message));
  EXPECT_EQ(from_message(message).error().where, "proximity.more");
}

}  // namespace
}  // namespace swarmsmith
