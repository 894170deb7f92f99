#include "robot/runtime/roll_call.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "robot/runtime/robot_kind.h"
#include "sim/files/robot_file.h"
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

/// Robots of a roll whose states the test writes, under a clock in milliseconds.
class Called {
 public:
  explicit Called(RunStarter::Settings settings = {.run = "run07", .seconds = 5, .seed = 9})
      : starter(std::move(settings), {"rvr1", "rvr2"}, "op", at(0)) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].robot = "rvr" + std::to_string(i + 1);
      states[i].phase = Phase::Ready;
      states[i].seed = 1;
      states[i].robot_index = static_cast<std::int64_t>(i);
    }
  }

  static Now at(int ms) {
    return {TimePoint(std::chrono::seconds(50) + milliseconds(ms)), 2000 + 1e-3 * ms};
  }
  void tell(int ms) {
    for (std::size_t i = 0; i < states.size(); ++i)
      starter.hear(i, states[i], at(ms));
  }
  /// What is sent at this time.
  std::vector<Order> tick(int ms) {
    std::vector<Order> orders = starter.tick(at(ms));
    for (const Order& order : orders) {
      if (order.kind == Order::Kind::Echo) last_echo = order;
    }
    return orders;
  }
  /// All answer ten echoes at once, so that the start is sent at this time.
  Order start(int ms) {
    for (int round = 0; round < RollCall::kEchoes; ++round) {
      tick(ms);
      for (NodeState& state : states) {
        state.order = last_echo.id;
        state.unix_s = at(ms).unix_s;
      }
      tell(ms);
    }
    const std::vector<Order> orders = tick(ms);
    EXPECT_EQ(orders.size(), 1U);
    return orders.empty() ? Order{} : orders[0];
  }
  /// All are in the run, in this phase.
  void set(Phase phase) {
    for (NodeState& state : states) {
      state.run = "run07";
      state.phase = phase;
    }
  }
  Order made(Order::Kind kind, int number, int ms) const {
    Order order;
    order.kind = kind;
    order.id = "op-" + std::to_string(number);
    order.run = "run07";
    order.robots = {"rvr1", "rvr2"};
    order.sent_unix_s = at(ms).unix_s;
    return order;
  }
  const std::vector<std::string>& complaints() const { return starter.complaints(); }

  std::array<NodeState, 2> states;
  RunStarter starter;
  Order last_echo;
};

TEST(RunStarter, SendsOneEchoAtATimeAndAnotherOneAfterAQuarterOfASecond) {
  Called called;
  const auto echo = [](int number, int ms) {
    Order order;
    order.kind = Order::Kind::Echo;
    order.id = "op-echo" + std::to_string(number);
    order.sent_unix_s = Called::at(ms).unix_s;
    order.valid_s = 10;
    return order;
  };
  EXPECT_THAT(called.tick(10), ElementsAre(echo(1, 10)));
  EXPECT_THAT(called.tick(259), IsEmpty());
  EXPECT_THAT(called.tick(260), ElementsAre(echo(2, 260)));
  // Each robot answers after another time; the fastest answer counts.
  const auto answer = [&called](std::size_t robot, int number, int ms, double ahead_s) {
    called.states[robot].order = "op-echo" + std::to_string(number);
    called.states[robot].unix_s = Called::at(ms).unix_s + ahead_s;
    called.starter.hear(robot, called.states[robot], Called::at(ms));
  };
  answer(0, 2, 300, 0.5);
  answer(1, 2, 300, 0);
  answer(1, 2, 310, 0);  // it says so again
  answer(0, 1, 310, 0);  // too late
  EXPECT_THAT(called.tick(310), ElementsAre(echo(3, 310)));
  answer(0, 3, 330, 0.25);
  EXPECT_THAT(called.tick(340), IsEmpty());
  answer(1, 3, 370, 0.25);
  EXPECT_THAT(called.tick(370), ElementsAre(echo(4, 370)));
  answer(0, 4, 390, 2);  // as fast as the one before
  const auto& robots = called.starter.roll().robots();
  EXPECT_EQ(robots[0].echoes, 3);
  EXPECT_NEAR(robots[0].echo_s, 0.02, 1e-9);
  EXPECT_NEAR(robots[0].offset_s, 0.25 + 0.01, 1e-9);
  EXPECT_EQ(robots[0].heard, Called::at(390).clock);
  EXPECT_EQ(robots[1].echoes, 2);
  EXPECT_NEAR(robots[1].echo_s, 0.04, 1e-9);
  EXPECT_NEAR(robots[1].offset_s, 0.02, 1e-9);
}

TEST(RollCall, ComplainsOfAllThatKeepsASwarmFromStarting) {
  using Change = std::function<void(NodeState&)>;
  struct Case {
    Change change;
    std::vector<std::string> complaints;
  };
  const Robot wanted = rvr();
  const auto of = [](const Change& change, const Robot* kind, int now_ms) {
    RollCall roll({"rvr1", "rvr2"}, "op");
    NodeState state{.robot = "rvr1",
                    .phase = Phase::Ready,
                    .machine_digest = "ab",
                    .flavour = "watermelon",
                    .turn_clock = "cycles",
                    .seed = 1,
                    .version = "v1"};
    const auto echo = value_of(roll.tick({TimePoint(), 0}));
    state.order = echo.id;
    roll.hear(0, state, {TimePoint(), 0});
    state.robot = "rvr2";
    state.robot_index = 1;
    change(state);
    roll.hear(1, state, {TimePoint(), 0});
    return roll.complaints(TimePoint(milliseconds(now_ms)), kind);
  };
  const std::string clock = " this computer's, more than 20 ms: synchronise them (chrony)";
  const std::string silent = ": does not answer; is its node running, and on this network?";
  const std::vector<Case> cases{
      {[](NodeState&) {}, {}},
      {[](NodeState& s) { s.order = "other"; },
       {"rvr2: does not answer orders, so its clock is not known; do they reach its node?"}},
      {[](NodeState& s) { s.robot = "rvr7"; }, {"rvr2: its node calls itself rvr7"}},
      {[](NodeState& s) {
         s.phase = Phase::Armed;
         s.run = "run01";
       },
       {"rvr2: the run run01 is in progress"}},
      {[](NodeState& s) {
         s.phase = Phase::Running;
         s.run = "run01";
       },
       {"rvr2: the run run01 is in progress"}},
      {[](NodeState& s) { s.phase = Phase::Ended; }, {}},
      {[](NodeState& s) { s.phase = Phase::Idle; }, {}},
      {[](NodeState& s) {
         s.not_ready = {"ground: no message yet", "log: full"};
       },
       {"rvr2: ground: no message yet", "rvr2: log: full"}},
      {[](NodeState& s) { s.unix_s = 0.02; }, {}},
      {[](NodeState& s) { s.unix_s = -0.02; }, {}},
      {[](NodeState& s) { s.unix_s = 0.021; }, {"rvr2: its clock is 21 ms ahead of" + clock}},
      {[](NodeState& s) { s.unix_s = -0.021; }, {"rvr2: its clock is 21 ms behind" + clock}},
      {[](NodeState& s) { s.machine_digest = "cd"; },
       {"rvr2: has the machine cd, and rvr1 has ab"}},
      {[](NodeState& s) { s.flavour = "chocolate"; },
       {"rvr2: has the flavour chocolate, and rvr1 has watermelon"}},
      {[](NodeState& s) { s.turn_clock = "seconds"; },
       {"rvr2: has the turn clock seconds, and rvr1 has cycles"}},
      {[](NodeState& s) { s.seed = 3; }, {"rvr2: has the seed 3, and rvr1 has 1"}},
      {[](NodeState& s) { s.version = "v2"; }, {"rvr2: has the version v2, and rvr1 has v1"}},
      {[](NodeState& s) { s.robot_index = 0; },
       {"rvr2: has the random stream 0, as rvr1: give it another --index"}}};
  for (const Case& one : cases) {
    EXPECT_EQ(of(one.change, &wanted, 1000), one.complaints);
    EXPECT_EQ(of(one.change, nullptr, 1000), one.complaints);
  }
  EXPECT_THAT(of([](NodeState&) {}, nullptr, 1001), ElementsAre("rvr1" + silent, "rvr2" + silent));

  const auto drives = [](const std::string& robot) {
    return [robot](NodeState& state) { state.own_robot = robot; };
  };
  const std::string own_rover = own_robot_text(rover());
  EXPECT_THAT(of(drives(own_rover), nullptr, 0),
              ElementsAre("rvr2: drives the robot rover, and rvr1 has rvr"));
  EXPECT_THAT(of(drives(own_rover), &wanted, 0),
              ElementsAre("rvr2: " + other_robot("the run", rvr(), rover()).value()));
  Robot fast = rvr();
  fast.drive.max_speed_mps = 0.25;
  EXPECT_THAT(of(drives(own_robot_text(fast)), nullptr, 0),
              ElementsAre("rvr2: drives the robot rvr, and rvr1 has one of other values"));
  for (const Robot* kind : {&wanted, static_cast<const Robot*>(nullptr)})
    EXPECT_THAT(of(drives("wings = 2\n"), kind, 0),
                ElementsAre(StartsWith("rvr2: its state has an `own_robot` that this program "
                                       "cannot read: ")));
}

TEST(RunStarter, SendsTheSameStartToAllAndThenSignsOfLife) {
  Called called({.run = "run07", .seconds = 5, .seed = 9, .kind = rover(), .lead_s = 3});
  for (NodeState& state : called.states)
    state.own_robot = own_robot_text(rover());
  Order start = called.made(Order::Kind::Start, 1, 40);
  start.at_unix_s = Called::at(3040).unix_s;
  start.seconds = 5;
  start.seed = 9;
  start.own_robot = own_robot_text(rover());
  start.clock_offsets_s = {{"rvr1", 0}, {"rvr2", 0}};
  EXPECT_EQ(called.start(40), start);
  EXPECT_EQ(called.starter.stage(), RunStarter::Stage::Ordered);
  EXPECT_EQ(called.starter.start().clock, Called::at(3040).clock);
  EXPECT_EQ(called.starter.start().unix_s, start.at_unix_s);
  EXPECT_THAT(called.tick(139), IsEmpty());
  EXPECT_THAT(called.tick(140), ElementsAre(called.made(Order::Kind::Alive, 2, 140)));
  called.set(Phase::Armed);
  called.tell(150);
  EXPECT_THAT(called.tick(239), IsEmpty());
  EXPECT_EQ(called.starter.stage(), RunStarter::Stage::Watching);
  EXPECT_THAT(called.tick(240), ElementsAre(called.made(Order::Kind::Alive, 3, 240)));
  EXPECT_FALSE(called.starter.has_begun());
  EXPECT_EQ(called.starter.verdict(), RunVerdict::Invalid) << "the run is not over";
}

TEST(RunStarter, WaitsFiveSecondsForAllToBeReady) {
  Called called;
  EXPECT_EQ(called.tick(5000).size(), 1U);
  EXPECT_EQ(called.starter.stage(), RunStarter::Stage::Calling);
  EXPECT_THAT(called.complaints(), IsEmpty()) << "robots are still asked";
  EXPECT_EQ(called.tick(5001).size(), 0U);
  EXPECT_EQ(called.starter.stage(), RunStarter::Stage::Over);
  EXPECT_EQ(called.complaints().size(), 2U);
  EXPECT_EQ(called.starter.verdict(), RunVerdict::Invalid);
  EXPECT_THAT(called.tick(9000), IsEmpty());
  called.starter.interrupt(Called::at(9000));
  EXPECT_EQ(called.complaints().size(), 2U) << "it is over";
}

/// Two robots in a run that began at 2 s.
class InRun : public Called {
 public:
  explicit InRun(Phase phase = Phase::Running) {
    start(0);
    set(phase);
    tell(0);
    tick(0);
  }
  RunStarter::Stage stage(int ms) {
    tick(ms);
    return starter.stage();
  }
  /// The robots repeat their states until this time.
  void pass(int from_ms, int to_ms) {
    for (int ms = from_ms; ms <= to_ms; ms += 100) {
      tell(ms);
      tick(ms);
    }
    tell(to_ms);
  }
};

using Stage = RunStarter::Stage;

TEST(RunStarter, GivesUpARobotThatIsSilentForASecond) {
  InRun run;
  EXPECT_EQ(run.stage(1000), Stage::Watching);
  EXPECT_EQ(run.stage(1001), Stage::Stopping);
  EXPECT_THAT(run.complaints(), ElementsAre("rvr1: has sent nothing for 1 s"));
  InRun ended;
  ended.states[1].phase = Phase::Ended;
  ended.tell(100);
  ended.starter.hear(0, ended.states[0], Called::at(1200));
  EXPECT_EQ(ended.stage(1200), Stage::Watching)
      << "a robot that has ended its run may be switched off";
  ended.states[1].log_open = true;
  ended.starter.hear(1, ended.states[1], Called::at(100));
  EXPECT_EQ(ended.stage(1200), Stage::Stopping) << "but not before its log is complete";
}

TEST(RunStarter, GivesUpWhenARobotRefusesOrLeavesTheRun) {
  const auto complaint = [](const auto& change) {
    InRun run;
    change(run.states[1]);
    run.tell(10);
    EXPECT_EQ(run.stage(20), Stage::Stopping);
    return run.complaints().empty() ? "" : run.complaints().front();
  };
  EXPECT_EQ(complaint([](NodeState& state) {
              state.order = "op-1";
              state.refused = "this order came before";
            }),
            "rvr2: refuses the start: this order came before");
  EXPECT_EQ(complaint([](NodeState& state) { state.phase = Phase::Stopped; }),
            "rvr2: stopped: no reason given");
  EXPECT_EQ(complaint([](NodeState& state) {
              state.phase = Phase::Failed;
              state.reasons = {"killed by order", "another reason"};
            }),
            "rvr2: failed: killed by order");
  InRun run;
  run.states[1].order = "op-2";
  run.states[1].refused = "the order is 2.0 s old";
  run.tell(10);
  EXPECT_EQ(run.stage(20), Stage::Watching) << "of another order";
}

TEST(RunStarter, GivesRobotsASecondToAcceptAndHalfASecondToBegin) {
  // rvr2 speaks of an earlier run, or is still ready.
  for (const bool of_earlier_run : {false, true}) {
    Called called;
    called.start(0);
    called.set(Phase::Armed);
    if (of_earlier_run) {
      called.states[1].run = "run06";
    } else {
      called.states[1].phase = Phase::Ready;
    }
    called.tell(500);
    called.tick(1000);
    EXPECT_EQ(called.starter.stage(), Stage::Ordered);
    called.tick(1001);
    EXPECT_EQ(called.starter.stage(), Stage::Stopping);
    EXPECT_THAT(called.complaints(), ElementsAre("not all robots accepted the start"));
  }
  InRun run(Phase::Armed);
  run.states[0].phase = Phase::Running;
  run.pass(100, 2500);
  EXPECT_EQ(run.stage(2500), Stage::Watching);
  EXPECT_FALSE(run.starter.has_begun());
  EXPECT_EQ(run.stage(2501), Stage::Stopping);
  EXPECT_THAT(run.complaints(), ElementsAre("rvr2: is not running 0.5 s after the start"));
  InRun prompt;
  prompt.pass(100, 2501);
  EXPECT_EQ(prompt.stage(2501), Stage::Watching);
  EXPECT_TRUE(prompt.starter.has_begun());
}

TEST(RunStarter, GivesRobotsTwoSecondsToEnd) {
  InRun run;
  run.pass(100, 9000);
  EXPECT_EQ(run.stage(9000), Stage::Watching);
  EXPECT_EQ(run.stage(9001), Stage::Stopping);
  EXPECT_THAT(run.complaints(), ElementsAre("not all robots ended the run"));
  InRun ended;
  ended.pass(100, 1000);
  ended.set(Phase::Ended);
  ended.states[0].verdict = RunVerdict::Degraded;
  ended.states[1].log_open = true;
  ended.tell(1100);
  EXPECT_EQ(ended.stage(1100), Stage::Watching);
  EXPECT_EQ(ended.starter.verdict(), RunVerdict::Invalid) << "a log is open";
  EXPECT_FALSE(ended.starter.has_begun());
  ended.states[1].log_open = false;
  ended.tell(1200);
  EXPECT_THAT(ended.tick(1200), IsEmpty());
  EXPECT_EQ(ended.starter.stage(), Stage::Over);
  EXPECT_TRUE(ended.starter.has_begun());
  EXPECT_EQ(ended.starter.verdict(), RunVerdict::Degraded);
  EXPECT_THAT(ended.complaints(), IsEmpty());
}

TEST(RunStarter, RepeatsTheOrderToStopUntilAllHaveStoppedOrForTwoSeconds) {
  InRun run;
  run.pass(100, 3000);
  const std::vector<Order> before = run.tick(3050);
  EXPECT_THAT(before, IsEmpty());
  run.starter.interrupt(Called::at(3060));
  EXPECT_THAT(run.complaints(), ElementsAre("interrupted: stopping all robots"));
  run.starter.interrupt(Called::at(3060));
  EXPECT_EQ(run.complaints().size(), 1U) << "it is already stopping";
  const int last = 31;  // orders: the start, and thirty signs of life
  EXPECT_THAT(run.tick(3060), ElementsAre(run.made(Order::Kind::Stop, last + 1, 3060)));
  EXPECT_THAT(run.tick(3259), IsEmpty());
  EXPECT_THAT(run.tick(3260), ElementsAre(run.made(Order::Kind::Stop, last + 2, 3260)));
  run.states[0].phase = Phase::Stopped;
  run.tell(3270);
  EXPECT_EQ(run.stage(3300), Stage::Stopping) << "one has not stopped";
  for (int ms = 3460; ms <= 5060; ms += 200)
    run.tick(ms);
  EXPECT_EQ(run.starter.stage(), Stage::Stopping);
  EXPECT_EQ(run.stage(5061), Stage::Over);
  EXPECT_THAT(run.complaints(), ElementsAre("interrupted: stopping all robots",
                                            "rvr2: did not confirm that it stopped; check the "
                                            "robot"));
  EXPECT_EQ(run.starter.verdict(), RunVerdict::Invalid);

  InRun prompt;
  prompt.starter.interrupt(Called::at(10));
  EXPECT_EQ(prompt.stage(10), Stage::Stopping) << "the order is sent at least once";
  prompt.set(Phase::Stopped);
  prompt.states[0].log_open = true;
  prompt.tell(20);
  EXPECT_EQ(prompt.stage(20), Stage::Stopping) << "its log is open";
  prompt.states[0].log_open = false;
  prompt.tell(30);
  EXPECT_EQ(prompt.stage(30), Stage::Over);
  EXPECT_THAT(prompt.complaints(), ElementsAre("interrupted: stopping all robots"));

  Called early;
  early.starter.interrupt(Called::at(10));
  EXPECT_EQ(early.starter.stage(), Stage::Over);
  EXPECT_THAT(early.complaints(), ElementsAre("interrupted before the start"));
  EXPECT_THAT(early.tick(20), IsEmpty());
  Called ordered;
  ordered.start(0);
  ordered.starter.interrupt(Called::at(10));
  EXPECT_EQ(ordered.starter.stage(), Stage::Stopping);
}

}  // namespace
}  // namespace swarmsmith
