#include "robot/world/real_time.h"

#include <atomic>
#include <thread>

#include "robot/transport/in_process.h"
#include "robot/world/sensor_messages.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// One robot in the middle, alone, for a while.
struct Scene {
  explicit Scene(int cycles)
      : profile(*built_in_profile("argos3")), mission(*built_in_mission("aggregation")) {
    mission.robots = 1;
    mission.cycles = cycles;
    instance = *instance_of(mission, 1);
    instance.starts = {{}};
  }
  WorldRun run() const {
    return {.profile = profile, .mission = mission, .instance = instance, .seed = 1};
  }

  Profile profile;
  Mission mission;
  Instance instance;
};

TEST(RealTime, ARobotWhoseCommandsEndStandsStill) {
  const Scene scene(25);
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  std::atomic<bool> over{false};
  // Drives when the first three readings come, then is silent.
  std::thread node([&] {
    int heard = 0;
    while (!over) {
      const auto message =
          swarm.robot(0).receive(SystemClock().now() + std::chrono::milliseconds(5));
      if (!message || !std::holds_alternative<RangesMessage>(*message) || ++heard > 3) continue;
      swarm.robot(0).send(WheelsMessage{{}, 0.3, 0.3, {}, {}});
    }
  });
  std::vector<double> x;
  const auto result =
      run_in_real_time(swarm.world(), world_topics(), scene.run(), {},
                       [&](const Snapshot& now) { x.push_back(now.robots[0].pose.x); });
  over = true;
  node.join();
  ASSERT_TRUE(result.has_value()) << to_string(result.error());
  EXPECT_GE(result->stops_by_silence, 1);  // once more where the node's thread got no processor
  ASSERT_EQ(x.size(), 26U);
  EXPECT_GT(x.back(), 0.001) << "it drove";
  EXPECT_LT(x.back(), 0.3 * 2.4) << "and did not go on";
  EXPECT_EQ(x[24], x[25]) << "at the end it stands";
}

TEST(RealTime, TheRobotsWaitInTheirPlacesForTheStart) {
  const Scene scene(3);
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  std::atomic<bool> over{false};
  TimePoint start{};
  std::thread node([&] {
    bool told = false;
    while (!over) {
      const auto message =
          swarm.robot(0).receive(SystemClock().now() + std::chrono::milliseconds(5));
      if (!message || told) continue;
      told = true;
      swarm.robot(0).send(StateMessage{{}, "armed"});
    }
  });
  RealTimeOptions options;
  options.start_of = [&](const StateMessage& state) -> std::optional<TimePoint> {
    EXPECT_EQ(state.text, "armed");
    if (start == TimePoint{}) start = SystemClock().now() + std::chrono::milliseconds(200);
    return start;
  };
  const auto result = run_in_real_time(swarm.world(), world_topics(), scene.run(), options);
  over = true;
  node.join();
  ASSERT_TRUE(result.has_value()) << to_string(result.error());
  EXPECT_EQ(result->start, start);
}

/// The operator pressed Ctrl-C before the start.
TEST(RealTime, AStartThatTheNodesGiveUpIsForgotten) {
  const Scene scene(3);
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  swarm.robot(0).send(StateMessage{{}, "armed"});
  swarm.robot(0).send(StateMessage{{}, "idle"});
  std::optional<TimePoint> start;
  RealTimeOptions options;
  options.start_of = [&](const StateMessage& state) -> std::optional<TimePoint> {
    if (state.text != "armed") return std::nullopt;
    return start = SystemClock().now() + std::chrono::milliseconds(50);
  };
  options.is_over = [&] { return start && SystemClock().now() > *start + std::chrono::seconds(1); };
  const auto result = run_in_real_time(swarm.world(), world_topics(), scene.run(), options);
  ASSERT_TRUE(start) << "the world heard of it";
  ASSERT_FALSE(result.has_value()) << "it began all the same";
  EXPECT_EQ(result.error().message, "stopped");
}

/// Its node was killed: it sends no other state. The operator stops the others before the start.
TEST(RealTime, TheStartOfANodeThatFellSilentIsForgotten) {
  const Scene scene(3);
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  swarm.robot(0).send(StateMessage{{}, "armed"});
  std::optional<TimePoint> start;
  RealTimeOptions options;
  options.start_of = [&](const StateMessage&) -> std::optional<TimePoint> {
    return start = SystemClock().now() + std::chrono::milliseconds(1500);
  };
  options.is_over = [&] { return start && SystemClock().now() > *start + std::chrono::seconds(1); };
  const auto result = run_in_real_time(swarm.world(), world_topics(), scene.run(), options);
  ASSERT_TRUE(start) << "the world heard of it";
  ASSERT_FALSE(result.has_value()) << "it began all the same";
  EXPECT_EQ(result.error().message, "stopped");
}

TEST(RealTime, ARobotThatDrivesBeforeTheStartIsRefused) {
  const Scene scene(3);
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  swarm.robot(0).send(WheelsMessage{{}, 0.3, 0.3, {}, {}});
  RealTimeOptions options;
  options.start_of = [](const StateMessage&) { return std::nullopt; };
  const auto result = run_in_real_time(swarm.world(), world_topics(), scene.run(), options);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().message, HasSubstr("before a run was started"));
}

}  // namespace
}  // namespace swarmsmith
