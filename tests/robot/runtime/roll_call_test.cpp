#include "robot/runtime/roll_call.h"

#include <algorithm>
#include <memory>

#include "robot/runtime/robot_kind.h"
#include "tests/robot/runtime/bench_robot.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

/// Three nodes and an operator under one clock that the test moves by 10 ms.
class Bench {
 public:
  explicit Bench(std::vector<NodeSettings> settings = {{}, {}, {}},
                 const std::vector<std::string>& machines = {kCuriousMachine, kCuriousMachine,
                                                             kCuriousMachine},
                 const Robot& kind = rvr()) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      names.push_back("rvr" + std::to_string(i + 1));
      if (settings[i].robot_index == 0) settings[i].robot_index = static_cast<int>(i);
      settings[i].robot = names.back();
      robots.push_back(std::make_unique<BenchRobot>(settings[i], machines[i]));
      robots.back()->alive = false;
      hears.push_back(true);
      speaks.push_back(true);
    }
    starter = std::make_unique<RunStarter>(
        RunStarter::Settings{.run = "run07", .seconds = 5, .kind = kind}, names, "op", now());
  }

  Now now() const { return {clock, robots[0]->unix_s()}; }

  void step() {
    clock += milliseconds(10);
    for (const auto& robot : robots)
      robot->clock = clock;
    for (const Order& order : starter->tick(now())) {
      sent.push_back(order);
      for (std::size_t i = 0; i < robots.size(); ++i) {
        if (!hears[i]) continue;
        robots[i]->node.hear(order, robots[i]->now());
        if (order.kind != Order::Kind::Alive) tell(i);
      }
    }
    if (++steps_ % 10 != 0) return;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots[i]->send_all();
      robots[i]->send_driver();
      robots[i]->tick();
      tell(i);
    }
  }

  void run(double seconds) {
    for (int i = 0; i < 100 * seconds && starter->stage() != RunStarter::Stage::Over; ++i)
      step();
  }

  /// After each robot's next tick.
  bool all_stand() {
    for (int i = 0; i < 10; ++i)
      step();
    return std::ranges::all_of(robots, [](const auto& robot) { return robot->speed() == 0; });
  }

  TimePoint clock{std::chrono::seconds(2000)};
  std::vector<std::unique_ptr<BenchRobot>> robots;
  std::vector<bool> hears;
  std::vector<bool> speaks;
  std::unique_ptr<RunStarter> starter;
  std::vector<Order> sent;

 private:
  void tell(std::size_t robot) {
    if (!speaks[robot]) return;
    const NodeState state = parse_state(state_text(robots[robot]->state())).value();
    starter->hear(robot, state, now());
  }

  int steps_ = 0;
};

TEST(RunStarter, BeginsARunOnAllRobotsAtOneInstantAndWaitsForItsEnd) {
  Bench bench;
  bench.run(12);
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Over);
  EXPECT_THAT(bench.starter->complaints(), IsEmpty());
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Valid);
  EXPECT_EQ(std::ranges::count(bench.sent, Order::Kind::Echo, &Order::kind), RollCall::kEchoes);
  for (const auto& robot : bench.robots) {
    EXPECT_EQ(robot->state().phase, Phase::Ended);
    EXPECT_EQ(robot->rows.size(), 49U);
    EXPECT_NEAR(robot->node.head().start_unix_s, bench.starter->start().unix_s, 1e-6);
    EXPECT_NEAR(robot->node.head().clock_offset_s.value(), 0, 1e-6);
  }
  EXPECT_TRUE(bench.all_stand());
}

TEST(RunStarter, MeasuresClocksAndRefusesThoseThatAreOff) {
  Bench bench;
  bench.robots[1]->wall_ahead_s = 0.015;
  bench.run(12);
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Valid);
  EXPECT_NEAR(bench.starter->roll().robots()[1].offset_s, 0.015, 1e-6);
  EXPECT_NEAR(bench.robots[1]->node.head().clock_offset_s.value(), 0.015, 1e-6);
  Bench off;
  off.robots[2]->wall_ahead_s = -0.5;
  off.run(12);
  EXPECT_THAT(off.starter->complaints(),
              ElementsAre(HasSubstr("rvr3: its clock is 500 ms behind")));
  EXPECT_EQ(off.starter->start().unix_s, 0) << "nothing was ordered";
  Bench far;
  far.robots[1]->wall_ahead_s = 5;
  far.run(12);
  EXPECT_THAT(far.starter->complaints(),
              ElementsAre(HasSubstr("rvr2: its clock is 5000 ms ahead")));
  EXPECT_EQ(far.robots[1]->state().refused, "") << "an echo is good for ten seconds";
  EXPECT_TRUE(off.robots[0]->rows.empty());
}

TEST(RunStarter, RefusesASwarmThatIsNotOne) {
  Bench seeds({{}, {.seed = 5}, {}});
  seeds.run(12);
  EXPECT_THAT(seeds.starter->complaints(), ElementsAre("rvr2: has the seed 5, and rvr1 has 1"));
  Bench machines({{}, {}, {}}, {kCuriousMachine, kCuriousMachine, "--nstates 1 --s0 1"});
  machines.run(12);
  EXPECT_THAT(machines.starter->complaints(), ElementsAre(HasSubstr("rvr3: has the machine")));
  Bench indices({{}, {.robot_index = 2}, {}});
  indices.run(12);
  EXPECT_THAT(indices.starter->complaints(),
              ElementsAre(HasSubstr("rvr3: has the random stream 2, as rvr2")));
  Bench silent;
  silent.speaks[1] = false;
  silent.robots[2]->ground = false;
  silent.run(12);
  EXPECT_THAT(silent.starter->complaints(),
              ElementsAre(HasSubstr("rvr2: does not answer"), "rvr3: ground: no message yet"));
  EXPECT_EQ(silent.starter->verdict(), RunVerdict::Invalid);
}

TEST(RunStarter, StartsOnlyNodesOfItsRobot) {
  const NodeSettings of_rover{.kind = rover()};
  Bench mixed({{}, of_rover, {}});
  mixed.run(12);
  EXPECT_THAT(mixed.starter->complaints(),
              ElementsAre("rvr2: " + other_robot("the run", rvr(), rover()).value()));
  EXPECT_EQ(mixed.starter->start().unix_s, 0) << "nothing was ordered";
  EXPECT_THAT(mixed.starter->roll().complaints(mixed.clock),
              Contains("rvr2: drives the robot rover, and rvr1 has rvr"));
  Bench rovers({of_rover, of_rover, of_rover}, {kCuriousMachine, kCuriousMachine, kCuriousMachine},
               rover());
  rovers.run(20);
  EXPECT_THAT(rovers.starter->complaints(), ElementsAre());
  EXPECT_EQ(rovers.starter->verdict(), RunVerdict::Valid);
}

/// Its states come, orders do not reach it.
TEST(RunStarter, StartsNothingWhileAClockIsNotMeasured) {
  Bench deaf;
  deaf.hears[1] = false;
  deaf.run(30);
  EXPECT_THAT(deaf.starter->complaints(), ElementsAre(HasSubstr("rvr2: does not answer orders")));
  EXPECT_EQ(deaf.starter->start().unix_s, 0) << "nothing was ordered";
  EXPECT_EQ(deaf.starter->stage(), RunStarter::Stage::Over);
}

TEST(RunStarter, WaitsForARobotThatGetsReady) {
  Bench bench;
  bench.robots[1]->ranges = false;
  bench.run(2);
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Calling);
  bench.robots[1]->ranges = true;
  bench.run(12);
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Valid);
}

TEST(RunStarter, StopsAllWhenOneFallsSilent) {
  Bench bench;
  bench.run(5);
  ASSERT_TRUE(bench.starter->has_begun());
  ASSERT_FALSE(bench.all_stand());
  bench.speaks[1] = false;
  bench.run(1.3);
  EXPECT_TRUE(bench.all_stand());
  EXPECT_EQ(bench.robots[0]->state().phase, Phase::Stopped);
  bench.run(5);
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Over);
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Invalid);
  EXPECT_THAT(bench.starter->complaints(),
              ElementsAre("rvr2: has sent nothing for 1 s",
                          HasSubstr("rvr2: did not confirm that it stopped")));
}

TEST(RunStarter, StopsAllWhenOneFails) {
  Bench bench;
  bench.run(5);
  bench.robots[2]->ranges = false;
  bench.run(2);
  EXPECT_TRUE(bench.all_stand());
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Invalid);
  EXPECT_THAT(bench.starter->complaints(),
              ElementsAre(HasSubstr("rvr3: failed: the treads stood in 3 of 50 cycles")));
}

TEST(RunStarter, StopsAllWhenOneDoesNotTakeTheStart) {
  Bench bench;
  while (bench.starter->stage() == RunStarter::Stage::Calling) {
    bench.hears[1] = bench.starter->roll().is_complete() ? false : true;
    bench.step();
  }
  bench.run(12);
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Invalid);
  EXPECT_TRUE(bench.robots[0]->rows.empty()) << "stopped before the agreed instant";
}

TEST(RunStarter, WaitsUntilAllLogsAreClosed) {
  Bench bench;
  for (const auto& robot : bench.robots)
    robot->node.set_log_open(true);
  bench.run(8.5);
  ASSERT_EQ(bench.robots[0]->state().phase, Phase::Ended);
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Watching);
  bench.robots[0]->node.set_log_open(false);
  bench.robots[1]->node.set_log_open(false);
  bench.robots[2]->node.set_log_trouble("the disk is full");
  bench.robots[2]->node.lose_log();
  bench.robots[2]->node.set_log_open(false);
  bench.run(1);
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Over);
  EXPECT_EQ(bench.starter->verdict(), RunVerdict::Invalid);
  EXPECT_THAT(bench.starter->complaints(),
              ElementsAre("rvr3: failed: the log is incomplete: the disk is full"));
}

TEST(RunStarter, StopsAllWhenThePersonWantsIt) {
  Bench bench;
  bench.run(5);
  bench.starter->interrupt(bench.now());
  bench.run(1);
  EXPECT_TRUE(bench.all_stand());
  EXPECT_EQ(bench.starter->stage(), RunStarter::Stage::Over);
  EXPECT_THAT(bench.starter->complaints(), ElementsAre(HasSubstr("interrupted")));
  Bench early;
  early.run(0.05);
  early.starter->interrupt(early.now());
  early.run(1);
  EXPECT_EQ(early.starter->start().unix_s, 0);
}

TEST(RunStarter, LeavesNoRobotRunningWhenItIsGone) {
  Bench bench;
  bench.run(5);
  ASSERT_FALSE(bench.all_stand());
  bench.hears = {false, false, false};  // the operator's computer is off
  for (int i = 0; i < 130; ++i)
    bench.step();
  EXPECT_TRUE(bench.all_stand());
  for (const auto& robot : bench.robots)
    EXPECT_EQ(robot->state().phase, Phase::Failed);
}

}  // namespace
}  // namespace swarmsmith
