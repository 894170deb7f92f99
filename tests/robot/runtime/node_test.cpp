#include "robot/runtime/node.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.h"
#include "robot/runtime/replay.h"
#include "robot/runtime/robot_kind.h"
#include "sim/files/robot_file.h"
#include "tests/robot/runtime/bench_robot.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

TEST(RobotNode, IsIdleUntilEverySensorThatTheMachineNeedsHasSpoken) {
  BenchRobot robot;
  robot.ground = robot.neighbours = false;
  EXPECT_FALSE(robot.cycle().command) << "a person may carry the robot";
  EXPECT_EQ(robot.state().phase, Phase::Idle);
  EXPECT_THAT(robot.state().not_ready,
              ElementsAre("ground: no message yet", "neighbours: no message yet"));
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("ground: no message yet"));
  robot.ground = robot.neighbours = true;
  EXPECT_FALSE(robot.cycle().command);
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  robot.ground = false;
  robot.cycles(3);
  robot.cycle(milliseconds(-50));
  EXPECT_EQ(robot.state().phase, Phase::Ready) << "350 ms";
  robot.cycle(milliseconds(-149));
  EXPECT_EQ(robot.state().phase, Phase::Idle) << "351 ms";
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Idle);
  EXPECT_THAT(robot.state().not_ready, ElementsAre("ground: silent for 0.60 s"));
}

TEST(RobotNode, NeedsNoSensorThatTheMachineDoesNotAskFor) {
  BenchRobot robot({}, "--nstates 1 --s0 1");
  robot.ranges = robot.ground = robot.neighbours = false;
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  BenchRobot asked({.also_needed = {true, false, false, false}}, "--nstates 1 --s0 1");
  asked.ranges = false;
  asked.cycle();
  EXPECT_THAT(asked.state().not_ready, ElementsAre("proximity: no message yet"));
}

TEST(RobotNode, BeginsAtTheAgreedInstantAndEndsByItself) {
  BenchRobot robot;
  robot.cycles(3);
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Armed);
  EXPECT_EQ(robot.state().run, "run07");
  const TimePoint start = robot.clock + milliseconds(1000);
  for (int i = 0; i < 9; ++i) {
    const Decision decision = robot.cycle();
    ASSERT_TRUE(decision.command);
    EXPECT_EQ(*decision.command, Command{});
    EXPECT_EQ(robot.state().phase, Phase::Armed);
  }
  EXPECT_EQ(robot.node.next_tick(robot.clock), start);
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Running);
  EXPECT_THAT(robot.rows, IsEmpty());
  EXPECT_EQ(robot.node.next_tick(robot.clock), start + milliseconds(100));
  robot.cycle(milliseconds(2));
  EXPECT_EQ(robot.node.next_tick(robot.clock), start + milliseconds(200)) << "without drift";
  ASSERT_EQ(robot.rows.size(), 1U);
  EXPECT_EQ(robot.rows[0].cycle, 1);
  EXPECT_NEAR(robot.rows[0].late_ms, 2, 1e-9);
  EXPECT_NEAR(robot.rows[0].sensed.time_s, 0.102, 1e-9);
  EXPECT_GT(robot.speed(), 0);
  robot.cycles(298);
  EXPECT_EQ(robot.state().phase, Phase::Running);
  const Decision end = robot.cycle();
  EXPECT_EQ(end.command, Command{});
  EXPECT_EQ(end.state, 0);
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.rows.size(), 299U);
  for (const LogRow& row : robot.rows)
    EXPECT_EQ(row.event, "") << row.cycle;
  EXPECT_EQ(robot.state().verdict, RunVerdict::Valid)
      << testing::PrintToString(robot.state().reasons);
  const Decision after = robot.cycle();
  EXPECT_EQ(after.command, Command{}) << "zero until the state is left";
  EXPECT_EQ(after.state, 0);
  EXPECT_FALSE(after.row);
  const LogHead head = robot.node.head();
  ASSERT_TRUE(head.end);
  EXPECT_EQ(head.end->state, "ended");
  EXPECT_EQ(head.end->stepped, 299);
  EXPECT_EQ(head.seconds, 30);
}

TEST(RobotNode, TakesAnotherStartAfterARunAndEachNameOnce) {
  BenchRobot robot;
  robot.seconds = 1;
  robot.start();
  robot.cycles(12);
  ASSERT_EQ(robot.state().phase, Phase::Ended);
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("has already had an order for run"));
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  robot.run = "run08";
  Order order = robot.order(Order::Kind::Start);
  order.seed = 99;
  order.clock_offsets_s = {{"rvr1", 0.004}};
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Armed);
  EXPECT_EQ(robot.node.head().seed, 99);
  EXPECT_EQ(robot.node.head().clock_offset_s, 0.004);
  EXPECT_EQ(robot.node.head().end, std::nullopt);
}

TEST(RobotNode, RefusesStartsThatAreOldRepeatedForOthersOrAtTheWrongTime) {
  BenchRobot robot;
  robot.cycles(2);
  const auto expect_refused = [&robot](double Order::*part, double more, const char* why) {
    Order order = robot.order(Order::Kind::Start);
    order.*part += more;
    robot.node.hear(order, robot.now());
    EXPECT_EQ(robot.state().phase, Phase::Ready) << why;
    EXPECT_THAT(robot.state().refused, HasSubstr(why));
    robot.cycle();
  };
  expect_refused(&Order::sent_unix_s, -5, "old");
  expect_refused(&Order::at_unix_s, -3, "ago");
  expect_refused(&Order::at_unix_s, 100, "ahead");
  expect_refused(&Order::seconds, -29.96, "shorter than a cycle");
  Order order = robot.order(Order::Kind::Start);
  order.robots = {"rvr9"};
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  order = robot.order(Order::Kind::Start);
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Armed);
  robot.node.hear(order, robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("came before"));
  EXPECT_EQ(robot.state().phase, Phase::Armed);
  order = robot.order(Order::Kind::Start);
  order.run = "run09";
  robot.node.hear(order, robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("the run run07 is in progress"));
}

TEST(RobotNode, RefusesStartsForAnotherRobot) {
  BenchRobot an_rvr;
  an_rvr.cycles(2);
  Order order = an_rvr.order(Order::Kind::Start);
  order.own_robot = own_robot_text(rover());
  an_rvr.node.hear(order, an_rvr.now());
  EXPECT_EQ(an_rvr.state().phase, Phase::Ready);
  EXPECT_EQ(an_rvr.state().refused, other_robot("the order", rover(), rvr()));
  order = an_rvr.order(Order::Kind::Start);
  order.own_robot = "[robot]\nname = \"rover\"\nwings = 2\n";
  an_rvr.node.hear(order, an_rvr.now());
  EXPECT_EQ(an_rvr.state().phase, Phase::Ready);
  EXPECT_THAT(an_rvr.state().refused,
              AllOf(HasSubstr("the order's `own_robot` is not a robot"), HasSubstr("wings")));
  an_rvr.node.hear(an_rvr.order(Order::Kind::Start), an_rvr.now());
  EXPECT_EQ(an_rvr.state().phase, Phase::Armed);
  EXPECT_EQ(an_rvr.node.head().own_robot, "");

  BenchRobot a_rover({.kind = rover()});
  a_rover.cycles(2);
  a_rover.node.hear(a_rover.order(Order::Kind::Start), a_rover.now());
  EXPECT_EQ(a_rover.state().phase, Phase::Ready);
  EXPECT_EQ(a_rover.state().refused, other_robot("the order", rvr(), rover()))
      << "an order that names no robot is for RVRs";
  order = a_rover.order(Order::Kind::Start);
  order.own_robot = own_robot_text(rover());
  a_rover.node.hear(order, a_rover.now());
  EXPECT_EQ(a_rover.state().phase, Phase::Armed) << a_rover.state().refused;
  EXPECT_EQ(a_rover.node.head().own_robot, order.own_robot);
}

TEST(RobotNode, IsStoppedByOrdersForAnyRobot) {
  BenchRobot robot;
  robot.start();
  Order order = robot.order(Order::Kind::Stop);
  order.own_robot = own_robot_text(rover());
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Stopped);
}

TEST(RobotNode, StepsTheFlavourAsItRunsOnItsRobot) {
  BenchRobot robot({.kind = rover(), .max_mps = 1}, "--nstates 1 --s0 0 --rwm0 1");
  robot.cycles(2);
  Order order = robot.order(Order::Kind::Start);
  order.own_robot = own_robot_text(rover());
  robot.node.hear(order, robot.now());
  robot.cycles(12);
  EXPECT_EQ(robot.speed(), rover().drive.max_speed_mps);
  const RunRecord record{robot.node.head(), robot.rows};
  const auto replayed = value_of(replay_log(record));
  EXPECT_GT(replayed.stepped, 0);
  EXPECT_FALSE(replayed.difference) << replayed.difference->what;
  RunRecord of_rvr = record;
  of_rvr.head.own_robot.clear();
  EXPECT_TRUE(value_of(replay_log(of_rvr)).difference);
}

TEST(RobotNode, TellsMachinesOfTwoFlavoursOfOneNameApart) {
  Flavour mine = watermelon();
  mine.name = "mine";
  Flavour other = mine;
  other.neighbours.attraction_gain += 1;
  EXPECT_NE(BenchRobot({}, kCuriousMachine, mine).state().machine_digest,
            BenchRobot({}, kCuriousMachine, other).state().machine_digest);
}

TEST(RobotNode, StopsByOrderOfItsRunAndOfNoOther) {
  BenchRobot robot;
  robot.start();
  robot.cycles(20);
  ASSERT_GT(robot.speed(), 0);
  Order order = robot.order(Order::Kind::Stop);
  order.run = "run06";
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Running);
  EXPECT_THAT(robot.state().refused, HasSubstr("the run run07 is in progress"));
  order = robot.order(Order::Kind::Stop);
  order.sent_unix_s -= 100;  // an old stop stops as well
  robot.node.hear(order, robot.now());
  EXPECT_EQ(robot.state().phase, Phase::Stopped);
  robot.cycle();
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Invalid);
  EXPECT_THAT(robot.state().reasons, ElementsAre("stopped by order after 2.0 s of 30.0 s"));
  robot.node.hear(robot.order(Order::Kind::Stop), robot.now());
  EXPECT_EQ(robot.state().refused, "no run is in progress");
}

TEST(RobotNode, AKillIsForGood) {
  BenchRobot robot;
  robot.start();
  robot.cycles(5);
  robot.node.hear(robot.order(Order::Kind::Kill), robot.now());
  robot.cycle();
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  robot.run = "run08";
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("killed by order: restart the node"));
  robot.wall_ahead_s = 5;  // after the run
  robot.cycle();
  robot.node.hear(robot.order(Order::Kind::Kill), robot.now());
  EXPECT_THAT(robot.state().reasons, Not(Contains(HasSubstr("clock"))));
}

TEST(RobotNode, StandsStillWhileASensorIsSilentAndGoesOn) {
  BenchRobot robot;
  robot.start();
  robot.cycles(20);
  const std::uint64_t drawn = robot.rows.back().drawn;
  robot.ranges = false;
  robot.cycles(2);  // 100 and 200 ms
  EXPECT_GT(robot.speed(), 0);
  EXPECT_EQ(robot.rows.back().event, "proximity: silent for 0.20 s");
  robot.cycles(1);  // 300 ms
  EXPECT_GT(robot.speed(), 0);
  const std::uint64_t before = robot.rows.back().drawn;
  robot.cycle();
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.rows.back().act, Act::Hold);
  EXPECT_EQ(robot.state().cycle, robot.rows.back().cycle);
  EXPECT_EQ(robot.rows.back().drawn, before) << "the machine is not stepped";
  EXPECT_EQ(robot.treads.leds[0], (Rgb{255, 0, 0}));
  EXPECT_EQ(robot.state().phase, Phase::Running);
  robot.ranges = true;
  robot.cycle();
  EXPECT_GT(robot.speed(), 0);
  EXPECT_GE(robot.rows.back().drawn, drawn);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons,
              ElementsAre("proximity was silent for up to 0.40 s: 1 cycle was not stepped"));
}

TEST(RobotNode, TakesABrokenSensorForASilentOneAndSaysWhich) {
  BenchRobot robot;
  robot.start();
  robot.cycles(20);
  robot.ranges = false;
  for (int i = 0; i < 11; ++i) {
    std::vector<double> ranges(8, 0.2);
    ranges[1] = std::nan("");
    robot.node.feeds().hear(RangesMessage{{robot.clock, 0}, ranges});
    robot.cycle();
  }
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  const std::vector<std::string> reasons = robot.state().reasons;
  EXPECT_THAT(reasons[0], HasSubstr("proximity sensor 1 (0 degrees) is missing"));
  robot.node.hear(robot.order(Order::Kind::Kill), robot.now());
  EXPECT_EQ(robot.state().reasons, reasons) << "the first problem is the cause";
}

TEST(RobotNode, EndsTheRunWhenSensorsWereSilentInMoreThanATwentiethOfIt) {
  BenchRobot robot;  // 300 cycles: 15 may be held
  robot.start();
  robot.cycles(5);
  for (int gap = 0; robot.state().phase == Phase::Running && gap < 40; ++gap) {
    robot.ranges = false;
    robot.cycles(5);  // the last two are held
    robot.ranges = true;
    robot.cycles(2);
  }
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_EQ(robot.state().held, 16);
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("the treads stood in 16 of 300 cycles"));
}

TEST(RobotNode, SaysWhenItsComputerWasTooBusy) {
  const auto verdict_after = [](int skips) {
    BenchRobot robot;
    robot.start();
    for (int i = 0; i < skips; ++i) {
      robot.clock += milliseconds(100);
      robot.cycle();
    }
    robot.cycles(300 - 2 * skips);
    EXPECT_EQ(robot.state().phase, Phase::Ended);
    EXPECT_EQ(robot.state().skipped, skips);
    EXPECT_EQ(robot.rows.size(), static_cast<std::size_t>(299 - skips));
    const std::string reason =
        fmt::format("{} of 300 cycles were skipped: the computer was too busy", skips);
    EXPECT_EQ(robot.state().reasons, skips > 3 ? std::vector{reason} : std::vector<std::string>());
    return robot.state().verdict;
  };
  EXPECT_EQ(verdict_after(3), RunVerdict::Valid);
  EXPECT_EQ(verdict_after(4), RunVerdict::Degraded);
  EXPECT_EQ(verdict_after(15), RunVerdict::Degraded);
  EXPECT_EQ(verdict_after(16), RunVerdict::Invalid);
}

TEST(RobotNode, CutsSpeedsAndSaysSo) {
  BenchRobot robot({.max_mps = 0.2});
  robot.start();
  robot.cycles(3);
  EXPECT_EQ(robot.speed(), 0.2);
  EXPECT_EQ(robot.rows.back().command.left_mps, 0.2);
  EXPECT_THAT(robot.rows.back().event, HasSubstr("speeds cut from 0.3 and 0.3 m/s"));
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons, ElementsAre("speeds were cut to 0.2 m/s in 3 cycles"));
}

TEST(RobotNode, LetsNothingPassThatIsNoSpeed) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(within_limits({std::nan(""), 0, {}}, 0.35), std::nullopt);
  EXPECT_EQ(within_limits({0, infinity, {}}, 0.35), std::nullopt);
  EXPECT_EQ(within_limits({-2, 0.1, {}}, 0.35), (Command{-0.35, 0.1, {}}));
}

TEST(RobotNode, EndsTheRunWhenTheOperatorIsGone) {
  BenchRobot robot;
  robot.start();
  robot.cycles(10);
  robot.alive = false;
  robot.cycles(10);
  EXPECT_EQ(robot.state().phase, Phase::Running);
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.state().reasons[0], "no message from the operator for 1.10 s");
  BenchRobot alone({.operator_gone = Duration::zero()});
  alone.alive = false;
  alone.start();
  alone.cycles(50);
  EXPECT_EQ(alone.state().phase, Phase::Running);
  EXPECT_GT(alone.speed(), 0);
  EXPECT_THAT(alone.state().reasons, IsEmpty());
}

TEST(RobotNode, StandsStillWithinHalfASecondOfItsOperatorsSilence) {
  BenchRobot robot;
  robot.start();
  robot.cycles(10);
  robot.alive = false;
  robot.cycles(3);
  EXPECT_GT(robot.speed(), 0);
  robot.cycle();  // 400 ms
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.rows.back().event, "no message from the operator for 0.40 s");
  EXPECT_EQ(robot.state().phase, Phase::Running);
  robot.alive = true;
  robot.cycle();
  EXPECT_GT(robot.speed(), 0);
  EXPECT_THAT(robot.state().reasons,
              ElementsAre("the operator was silent, for up to 0.40 s, at 1.0 s: 1 cycle was not "
                          "stepped"));
}

TEST(RobotNode, GoesOnWhenAClockIsSteppedAndSaysWhich) {
  for (const double step_s : {-5.0, 5.0}) {
    BenchRobot robot;
    robot.start();
    robot.cycles(10);
    robot.wall_ahead_s = step_s;  // of the robot's own
    robot.cycles(30);
    EXPECT_EQ(robot.state().phase, Phase::Running);
    EXPECT_GT(robot.speed(), 0);
    EXPECT_EQ(robot.state().verdict, RunVerdict::Valid);
    EXPECT_THAT(
        robot.state().reasons,
        ElementsAre(HasSubstr("this computer's clock was stepped by " +
                              std::string(step_s > 0 ? "+5.00" : "-5.00") + " s at 1.1 s")));
    EXPECT_THAT(robot.rows[10].event, HasSubstr("this computer's clock was stepped"));
  }
  BenchRobot ahead;
  ahead.start();
  ahead.cycles(10);
  ahead.operator_ahead_s = 7;
  ahead.cycles(30);
  EXPECT_EQ(ahead.state().phase, Phase::Running);
  EXPECT_THAT(ahead.state().reasons,
              ElementsAre(HasSubstr("the operator's clock was stepped by +7.00 s")));
  BenchRobot back;  // may as well be orders that were held up
  back.start();
  back.cycles(10);
  back.operator_ahead_s = -7;
  back.cycles(30);
  EXPECT_EQ(back.state().phase, Phase::Failed);
  EXPECT_THAT(back.state().reasons[0], HasSubstr("times 7.00 s too early"));
}

TEST(RobotNode, HearsOnlyTheOperatorOfItsRun) {
  BenchRobot robot;
  robot.start();
  robot.alive = false;
  for (int i = 0; i < 12; ++i) {
    Order alive = robot.order(Order::Kind::Alive);
    alive.run = "run06";
    robot.node.hear(alive, robot.now());
    Order old = robot.order(Order::Kind::Alive);
    old.sent_unix_s -= 30;  // played back
    robot.node.hear(old, robot.now());
    robot.cycle();
  }
  EXPECT_EQ(robot.state().phase, Phase::Failed);
}

TEST(RobotNode, WantsABatteryAndADriver) {
  BenchRobot robot;
  robot.node.hear(BatteryMessage{.charge = 0.15});
  robot.cycle();
  robot.node.driver().set_listeners({}, robot.clock);
  EXPECT_THAT(robot.state().not_ready,
              ElementsAre(HasSubstr("driver"), "battery: 15 %, at least 20 % are needed"));
  robot.node.hear(BatteryMessage{.charge = 0.8});
  robot.node.hear(BatteryMessage{.charge = std::nan("")});
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  EXPECT_EQ(robot.state().battery, std::nullopt);
}

TEST(RobotNode, StandsStillAfterASignal) {
  BenchRobot robot;
  robot.start();
  robot.cycles(10);
  robot.node.stop("by SIGTERM");
  robot.cycle();
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.state().phase, Phase::Stopped);
  EXPECT_THAT(robot.state().reasons, ElementsAre(HasSubstr("stopped by SIGTERM")));
}

TEST(RobotNode, FailsAfterARunWhoseLogIsNotWhole) {
  BenchRobot robot;
  robot.seconds = 1;
  robot.start();
  robot.node.set_log_trouble("no space left on device");
  EXPECT_EQ(robot.state().log_trouble, "no space left on device");
  robot.cycles(5);
  EXPECT_EQ(robot.state().phase, Phase::Running) << "the robot goes on";
  EXPECT_GT(robot.speed(), 0);
  robot.cycles(6);
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  robot.node.driver().set_listeners({{"driver", robot.clock}, {"late", robot.clock}}, robot.clock);
  robot.node.lose_log();
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_THAT(robot.state().reasons, ElementsAre("the log is incomplete: no space left on device"));
  robot.run = "run08";
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_THAT(robot.state().refused, HasSubstr("log: no space left"));
}

TEST(RobotNode, DoesNotBeginWithoutALog) {
  BenchRobot robot;
  robot.cycles(2);
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  robot.node.disarm("the log cannot be written: read-only");
  EXPECT_EQ(robot.state().phase, Phase::Idle);
  EXPECT_FALSE(robot.cycle().command) << "a person may carry the robot";
  robot.cycles(20);
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  EXPECT_EQ(robot.state().refused, "the log cannot be written: read-only");
  EXPECT_EQ(robot.state().run, "");
  EXPECT_THAT(robot.rows, IsEmpty());
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_EQ(robot.state().refused,
            "the robot has already had an order for run run07; a new run needs a new name");
  robot.clock += milliseconds(2000);
  robot.send_all();
  robot.node.driver().set_listeners({{"other", robot.clock}}, robot.clock);
  robot.node.driver().hear(DrivenMessage{{robot.clock - milliseconds(1500), 0}, 0, 0, "other"});
  EXPECT_THAT(robot.state().not_ready,
              ElementsAre("driver: other has not reported what the treads do for 1.5 s"))
      << "its reports count again";
}

TEST(RobotNode, HasItsTimeSinceTheStartInEachRow) {
  BenchRobot robot;
  robot.start();
  robot.cycles(20);
  robot.ranges = false;  // silent: the robot stands
  robot.cycles(8);
  ASSERT_GT(robot.rows.size(), 25U);
  std::set<Act> acts;
  for (const LogRow& row : robot.rows) {
    acts.insert(row.act);
    EXPECT_NEAR(row.sensed.time_s, 0.1 * static_cast<double>(row.cycle), 0.11) << row.cycle;
    EXPECT_NEAR(row.sensed.time_s,
                row.clock_s - robot.rows[0].clock_s + robot.rows[0].sensed.time_s, 1e-9);
  }
  EXPECT_EQ(acts, (std::set{Act::Step, Act::Hold}));
}

TEST(RobotNode, InLockStepTakesCyclesInOrderOnly) {
  BenchRobot robot({.max_mps = kMaxWheelSpeed_mps});
  const auto senses = [](std::int64_t seed, std::int64_t cycle) {
    SensesMessage message{.seed = seed, .cycle = cycle, .time_s = 0.1 * static_cast<double>(cycle)};
    message.ranges_m.fill(std::numeric_limits<double>::infinity());
    return message;
  };
  EXPECT_FALSE(robot.node.answer(senses(7, 2), robot.now()));
  EXPECT_TRUE(robot.node.answer(senses(7, 1), robot.now()));
  EXPECT_EQ(robot.state().run, "run-seed7");
  EXPECT_TRUE(robot.node.answer(senses(7, 2), robot.now()));
  EXPECT_TRUE(robot.node.answer(senses(8, 1), robot.now())) << "the next run";
  EXPECT_EQ(why_not(robot.node.answer(senses(8, 3), robot.now())).message,
            "cycle 3 of seed 8 came after cycle 1 of seed 8");
  SensesMessage gray = senses(9, 1);
  gray.color[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(why_not(robot.node.answer(gray, robot.now())).message,
            "the colour of cycle 1 is not a number");
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_FALSE(robot.node.answer(senses(8, 2), robot.now()));
  EXPECT_TRUE(robot.node.answer(senses(9, 1), robot.now()));
  EXPECT_TRUE(robot.node.answer(senses(9, 0), robot.now()));
  EXPECT_EQ(robot.state().phase, Phase::Ended);
}

TEST(RobotNode, InCountedLockStepHasTheWorldsTimeInEachRow) {
  BenchRobot robot({.max_mps = kMaxWheelSpeed_mps});
  robot.send_all();
  robot.node.begin_counted(robot.now());
  EXPECT_TRUE(robot.node.head().lock_step);
  EXPECT_EQ(robot.node.head().run, "run-seed1");
  for (int cycle = 1; cycle <= 3; ++cycle) {
    const Decision decision = robot.node.step_counted(robot.now());
    EXPECT_EQ(decision.row->cycle, cycle);
    EXPECT_NEAR(decision.row->sensed.time_s, 0.1 * cycle, 1e-12);
    EXPECT_EQ(decision.row->sensed.ground, (Rgb{127, 127, 127}));
  }
  robot.node.stop("by SIGTERM");
  EXPECT_THAT(robot.state().reasons, ElementsAre("stopped by SIGTERM"))
      << "the world knows how long a run is";
}

TEST(RobotNode, InLockStepIsWhatTheControllerIs) {
  BenchRobot robot({.robot_index = 3, .max_mps = kMaxWheelSpeed_mps});
  const Flavour& flavour = watermelon();
  const Controller controller = parse_controller(kCuriousMachine, flavour).value();
  ControlSoftware control(controller, flavour, control_stream(55, 3));
  Rng rng(5);
  for (std::int64_t cycle = 1; cycle <= 300; ++cycle) {
    SensesMessage message{.seed = 55, .cycle = cycle, .time_s = 0.1 * static_cast<double>(cycle)};
    for (double& range : message.ranges_m)
      range = rng.bernoulli(0.5) ? rng.uniform(0.05, 0.4) : std::numeric_limits<double>::infinity();
    message.color.fill(rng.bernoulli(0.3) ? 0 : 127);
    if (rng.bernoulli(0.5)) message.neighbours = {{0.5, 0.6, -0.8}};
    Sensed sensed{.time_s = message.time_s, .proximity_m = message.ranges_m};
    const auto gray = static_cast<std::uint8_t>(message.color[0]);
    sensed.ground = {gray, gray, gray};
    for (const SeenRobot& seen : message.neighbours)
      sensed.neighbours.push_back({seen.distance_m, seen.direction_x, seen.direction_y});
    SensedSenses senses(sensed);
    const Command wanted = control.step(senses);
    const auto decision = value_of(robot.node.answer(message, robot.now()));
    EXPECT_EQ(*decision.command, wanted);
    EXPECT_EQ(decision.state, control.state());
    EXPECT_EQ(decision.row->drawn, control.drawn());
    EXPECT_EQ(decision.row->sensed.time_s, message.time_s) << "the world's time";
  }
}

/// All that a node lets others see of its run.
struct Seen {
  NodeState state;
  LogHead head;
  std::vector<std::string> rows;
};

Seen seen_of(const BenchRobot& robot) {
  Seen seen{.state = robot.state(), .head = robot.node.head(), .rows = {}};
  for (const LogRow& row : robot.rows)
    seen.rows.push_back(text_of(row));
  return seen;
}

TEST(RobotNode, MakesASecondRunLikeAFirstOne) {
  // One robot has had these runs, one after the other, before the compared one.
  const NodeSettings settings{.max_mps = 0.25};
  using Deed = std::function<void(BenchRobot&)>;
  const std::vector<Deed> troubles{
      [](BenchRobot& robot) {  // its driver disobeys
        robot.obeys = false;
        robot.cycles(15);
        robot.obeys = true;
      },
      [](BenchRobot& robot) {  // its log is lost after it stood for its sensors and operator
        robot.ranges = robot.alive = false;
        robot.cycles(5);
        robot.ranges = true;
        robot.cycle();
        robot.alive = true;
        robot.cycle();
        robot.clock += milliseconds(300);
        robot.wall_ahead_s = 5;
        robot.cycles(2);
        robot.wall_ahead_s = 0;
        robot.cycles(2);
        robot.node.lose_log();
      },
      [](BenchRobot& robot) {  // the last messages of its operator are too early, then too late
        robot.operator_ahead_s = 5;
        robot.node.hear(robot.order(Order::Kind::Alive), robot.now());
        robot.operator_ahead_s = -5;
        robot.node.hear(robot.order(Order::Kind::Alive), robot.now());
        robot.operator_ahead_s = 0;
        robot.node.stop("by SIGTERM");
      }};
  const Deed story = [](BenchRobot& robot) {
    robot.cycles(60);
    robot.ranges = false;
    robot.cycles(4);
    robot.ranges = true;
    robot.cycles(2);
    robot.obeys = false;
    robot.cycles(5);
    robot.obeys = true;
    robot.cycles(2);
    robot.alive = false;
    robot.cycles(4);
    robot.alive = true;
    robot.cycles(240);
  };
  for (const bool has_operator : {true, false}) {
    BenchRobot used(settings);
    int runs = 0;
    for (const Deed& trouble : troubles) {
      used.run = "before" + std::to_string(++runs);
      used.cycles(2);
      Order start = used.order(Order::Kind::Start);
      start.seed = 3;
      start.clock_offsets_s = {{"rvr1", 0.25}};
      used.node.hear(start, used.now());
      used.cycles(30);
      trouble(used);
      used.cycles(3);
      EXPECT_NE(used.state().verdict, RunVerdict::Valid);
      EXPECT_FALSE(used.node.is_on());
    }
    BenchRobot fresh(settings);
    fresh.clock = used.clock;
    std::vector<Seen> seen;
    for (BenchRobot* robot : {&used, &fresh}) {
      robot->rows.clear();
      robot->treads = {};
      robot->cycles(50);
      robot->run = "run07";
      robot->alive = has_operator;
      robot->start();
      EXPECT_THAT(robot->state().reasons, IsEmpty());
      EXPECT_EQ(robot->state().verdict, RunVerdict::Valid);
      if (has_operator) {
        story(*robot);
      } else {
        robot->cycles(3);
      }
      seen.push_back(seen_of(*robot));
      seen.back().state.order.clear();  // orders have numbers
    }
    EXPECT_EQ(seen[0].state, seen[1].state);
    EXPECT_EQ(seen[0].head, seen[1].head);
    EXPECT_EQ(seen[0].rows, seen[1].rows);
    EXPECT_EQ(seen[1].state.phase, has_operator ? Phase::Ended : Phase::Failed);
    if (has_operator) {
      EXPECT_THAT(seen[1].state.reasons,
                  ElementsAre(HasSubstr("proximity was silent for up to"), HasSubstr("driver: "),
                              HasSubstr("the operator was silent, for up to 0.40 s"),
                              StartsWith("speeds were cut to 0.25 m/s in ")));
    } else {
      EXPECT_THAT(seen[1].state.reasons, ElementsAre("no message from the operator for 1.10 s"));
    }
  }
}

TEST(RobotNode, SaysAllOfItselfBeforeDuringAndAfterARun) {
  BenchRobot robot({.robot = "rvr5",
                    .robot_index = 3,
                    .seed = 9,
                    .max_mps = 0.5,
                    .version = "v7",
                    .scheduling = "SCHED_FIFO 20",
                    .host = "raspberry",
                    .topics = {{"ranges", "/ranges"}}});
  LogHead head{.run = "",
               .robot = "rvr5",
               .robot_index = 3,
               .machine = print_controller(parse_controller(kCuriousMachine, watermelon()).value(),
                                           watermelon()),
               .machine_digest = robot.state().machine_digest,
               .flavour = "watermelon",
               .turn_clock = std::string(name_of(watermelon().exploration.turn_clock)),
               .seed = 9,
               .period_s = 0.1,
               .seconds = 0,
               .max_mps = 0.5,
               .program = "v7",
               .host = "raspberry",
               .scheduling = "SCHED_FIFO 20",
               .topics = {{"ranges", "/ranges"}}};
  EXPECT_EQ(robot.node.head(), head) << "before any run";
  EXPECT_EQ(head.machine_digest.size(), 32U);
  const double nan = std::nan("");
  robot.node.hear(BatteryMessage{.charge = 0.2});
  robot.ground = false;
  robot.cycle();
  robot.clock += milliseconds(20);
  NodeState state{.robot = "rvr5",
                  .phase = Phase::Idle,
                  .machine_digest = head.machine_digest,
                  .flavour = "watermelon",
                  .turn_clock = head.turn_clock,
                  .seed = 9,
                  .robot_index = 3,
                  .version = "v7",
                  .scheduling = "SCHED_FIFO 20",
                  .age_ms = {20, -1, 20, std::nullopt},
                  .battery = 0.2,
                  .not_ready = {"ground: no message yet"},
                  .clock_s = 1000.12,
                  .unix_s = 1000.12};
  EXPECT_EQ(robot.state(), state);
  robot.node.hear(BatteryMessage{.charge = nan});
  robot.clock += milliseconds(80);
  robot.ground = true;
  robot.cycle();
  Order start = robot.order(Order::Kind::Start);
  start.seed = 77;
  start.clock_offsets_s = {{"rvr1", 0.25}, {"rvr5", -0.5}};
  robot.node.hear(start, robot.now());
  robot.node.set_log_open(true);
  state.phase = Phase::Armed;
  state.run = "run07";
  state.seed = 77;
  state.age_ms = {0, 0, 0, std::nullopt};
  state.battery = std::nullopt;
  state.not_ready.clear();
  state.log_open = true;
  state.order = start.id;
  state.start_unix_s = start.at_unix_s;
  state.clock_s = state.unix_s = 1000.3;
  EXPECT_EQ(robot.state(), state);
  robot.cycles(32);
  state.phase = Phase::Running;
  state.cycle = 22;
  state.clock_s = state.unix_s = 1003.5;
  EXPECT_EQ(robot.state(), state);
  head.run = "run07";
  head.seed = 77;
  head.seconds = 30;
  head.start_clock_s = head.start_unix_s = 1001.3;
  head.clock_offset_s = -0.5;
  EXPECT_EQ(robot.node.head(), head);
  robot.ranges = false;
  robot.cycles(5);
  robot.ranges = true;
  robot.clock += milliseconds(100);
  robot.cycle();
  robot.node.hear(robot.order(Order::Kind::Stop), robot.now());
  state.phase = Phase::Stopped;
  state.cycle = 29;
  state.held = 2;
  state.skipped = 1;
  state.seed = 9;
  state.start_unix_s = 0;
  state.order = "bench-42";
  state.verdict = RunVerdict::Invalid;
  state.reasons = {"stopped by order after 2.9 s of 30.0 s",
                   "proximity was silent for up to 0.50 s: 2 cycles were not stepped"};
  state.clock_s = state.unix_s = 1004.2;
  EXPECT_EQ(robot.state(), state);
  head.end = RunEnd{.state = "stopped",
                    .verdict = RunVerdict::Invalid,
                    .reasons = state.reasons,
                    .stepped = 26,
                    .held = 2,
                    .skipped = 1,
                    .driven = true};
  EXPECT_EQ(robot.node.head(), head);
}

TEST(RobotNode, NeedsTheFeedsOfItsMachine) {
  const Flavour chocolate = find_flavour("chocolate", TurnClock::Cycles).value();
  const auto needed = [](const std::string& machine, const Flavour& flavour) {
    return BenchRobot({}, machine, flavour).node.needed();
  };
  EXPECT_EQ(needed("--nstates 1 --s0 1", watermelon()), (PerFeed<bool>{}));
  EXPECT_EQ(needed("--nstates 1 --s0 2 --att0 2", watermelon()),
            (PerFeed<bool>{true, false, true, false}));
  EXPECT_EQ(needed(kCuriousMachine, watermelon()), (PerFeed<bool>{true, true, true, false}));
  EXPECT_EQ(needed(kLightMachine, chocolate), (PerFeed<bool>{true, false, false, true}));
}

TEST(RobotNode, TellsMachinesFlavoursAndTurnClocksApart) {
  const auto digest = [](const char* machine, const char* flavour, TurnClock clock) {
    return BenchRobot({}, machine, find_flavour(flavour, clock).value()).state().machine_digest;
  };
  std::set<std::string> digests;
  for (const char* machine : {"--nstates 1 --s0 0 --rwm0 1", "--nstates 1 --s0 1"}) {
    for (const char* flavour : {"watermelon", "chocolate"}) {
      for (const TurnClock clock : {TurnClock::Cycles, TurnClock::Seconds})
        digests.insert(digest(machine, flavour, clock));
    }
  }
  EXPECT_EQ(digests.size(), 8U);
}

TEST(RobotNode, AStartIsInTheNextMinuteAndLastsACycleAtLeast) {
  struct Case {
    double ahead_s;
    double seconds;
    const char* refused;
  };
  for (const Case& of :
       {Case{60, 30, ""}, Case{0.125, 30, ""}, Case{1, 0.1, ""}, Case{1, 0.05, ""},
        Case{60.25, 30, "the start is 60.2 s ahead; it must be more than 0 and at most 60 s ahead"},
        Case{0, 30, "the start is 0.0 s ago; it must be more than 0 and at most 60 s ahead"},
        Case{-1.5, 30, "the start is 1.5 s ago; it must be more than 0 and at most 60 s ahead"},
        Case{1, 0.04, "a run of 0.04 s is shorter than a cycle of 0.1 s"}}) {
    BenchRobot robot;
    robot.clock -= milliseconds(200);
    robot.cycles(2);  // to a second without a fraction, so that differences are exact
    Order order = robot.order(Order::Kind::Start);
    order.at_unix_s = robot.unix_s() + of.ahead_s;
    order.seconds = of.seconds;
    robot.node.hear(order, robot.now());
    EXPECT_EQ(robot.state().refused, of.refused) << of.ahead_s;
    EXPECT_EQ(robot.state().phase, *of.refused == 0 ? Phase::Armed : Phase::Ready) << of.ahead_s;
    EXPECT_EQ(robot.node.head().seconds, *of.refused == 0 ? of.seconds : 0);
  }
}

TEST(RobotNode, RefusesAStartWithAllItsReasons) {
  BenchRobot robot;
  robot.node.hear(BatteryMessage{.charge = 0.19});
  robot.node.set_log_trouble("read-only");
  robot.node.refuse_order("not JSON");
  EXPECT_EQ(robot.state().refused, "not JSON");
  robot.node.driver().set_listeners({{"driver", robot.clock}}, robot.clock);
  robot.neighbours = false;
  robot.send_all();
  robot.node.hear(robot.order(Order::Kind::Kill), robot.now());
  robot.node.hear(robot.order(Order::Kind::Start), robot.now());
  EXPECT_EQ(robot.state().refused,
            "killed by order: restart the node; neighbours: no message yet; "
            "battery: 19 %, at least 20 % are needed; log: read-only");
  robot.node.hear(robot.order(Order::Kind::Echo), robot.now());
  EXPECT_EQ(robot.state().refused, "");
  EXPECT_TRUE(robot.node.was_killed());
}

TEST(RobotNode, TicksOncePerPeriodAndAtTheAgreedInstant) {
  BenchRobot robot;
  robot.seconds = 1;
  robot.cycles(2);
  EXPECT_EQ(robot.node.next_tick(robot.clock + milliseconds(30)), robot.clock + milliseconds(100));
  EXPECT_EQ(robot.node.next_tick(robot.clock + milliseconds(300)), robot.clock + milliseconds(300));
  Order order = robot.order(Order::Kind::Start);
  order.at_unix_s = robot.unix_s() + 0.25;
  robot.node.hear(order, robot.now());
  const TimePoint start = robot.clock + milliseconds(250);
  EXPECT_EQ(robot.node.next_tick(robot.clock), robot.clock + milliseconds(100));
  robot.cycles(2);
  EXPECT_EQ(robot.node.next_tick(robot.clock), start);
  robot.cycle(milliseconds(-50));
  EXPECT_EQ(robot.state().phase, Phase::Running) << "at the agreed instant";
  EXPECT_EQ(robot.node.next_tick(robot.clock), start + milliseconds(100));
  EXPECT_FALSE(robot.cycle(milliseconds(-60)).command) << "too early";
  robot.cycles(12);
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.node.next_tick(robot.clock), robot.clock + milliseconds(100));
}

TEST(RobotNode, ASensorMayBeSilentUpToItsLimits) {
  const NodeSettings settings{.also_needed = {true, true, true, true}};
  const Flavour chocolate = find_flavour("chocolate", TurnClock::Cycles).value();
  for (const Feed feed : kAllFeeds) {
    const std::string name(name_of(feed));
    const auto row_after = [&](int silent_ms) {
      BenchRobot robot(settings, kLightMachine, chocolate);
      robot.light = true;
      robot.start();
      robot.cycles(20);
      *std::array{&robot.ranges, &robot.ground, &robot.neighbours, &robot.light}[index_of(feed)] =
          false;
      robot.cycles(silent_ms / 100 - 1);
      robot.cycle(milliseconds(silent_ms % 100));
      EXPECT_EQ(robot.state().phase, silent_ms > 1000 ? Phase::Failed : Phase::Running) << name;
      if (silent_ms > 1000) {
        EXPECT_EQ(robot.state().verdict, RunVerdict::Invalid);
        EXPECT_EQ(robot.state().reasons[0], robot.rows.back().event);
      }
      LogRow row = robot.rows.back();
      EXPECT_EQ(row.command.left_mps == 0, row.act == Act::Hold);
      PerFeed<std::optional<double>> ages;
      ages.fill(static_cast<double>(silent_ms % 100));
      ages[index_of(feed)] = silent_ms;
      EXPECT_EQ(row.age_ms, ages) << name;
      return row;
    };
    const int hold_ms = feed == Feed::Proximity ? 300 : 350;
    EXPECT_EQ(row_after(150).event, "") << name;
    EXPECT_EQ(row_after(151).event, name + ": silent for 0.15 s");
    EXPECT_EQ(row_after(hold_ms).act, Act::Step) << name;
    const LogRow held = row_after(hold_ms + 1);
    EXPECT_EQ(held.act, Act::Hold) << name;
    EXPECT_EQ(held.event, fmt::format("{}: silent for 0.{} s", name, hold_ms / 10));
    EXPECT_EQ(held.command.leds[4], (Rgb{255, 0, 0}));
    EXPECT_EQ(row_after(1000).event, name + ": silent for 1.00 s");
    EXPECT_EQ(row_after(1001).event, name + ": silent for 1.00 s");
  }
}

TEST(RobotNode, NamesTheSensorThatIsSilentForLongest) {
  BenchRobot robot;
  robot.start();
  robot.cycles(20);
  robot.ground = false;
  robot.cycles(2);
  robot.ranges = robot.neighbours = false;
  robot.cycles(4);
  EXPECT_EQ(robot.rows.back().event, "ground: silent for 0.60 s");
  robot.ground = true;
  robot.cycle();
  EXPECT_EQ(robot.rows.back().event, "proximity: silent for 0.50 s") << "the first of two";
}

TEST(RobotNode, JudgesAHeldCycleAtOnceAndLogsItsReadings) {
  BenchRobot robot;
  robot.node.feeds().set_wall_offset(std::chrono::seconds(5));
  robot.start();
  robot.cycles(20);
  robot.ranges = false;
  robot.cycles(3);
  robot.ground = false;
  GroundColorMessage ground{{robot.clock, 0}, 10, 20.6, 30};
  ground.arrival.at += milliseconds(90);
  ground.arrival.stamp_ns = (ground.arrival.at.time_since_epoch() + milliseconds(4988)).count();
  robot.node.feeds().hear(ground);
  robot.cycle(milliseconds(7));
  EXPECT_EQ(
      robot.state().reasons,
      std::vector<std::string>{"proximity was silent for up to 0.41 s: 1 cycle was not stepped"});
  const LogRow& row = robot.rows.back();
  EXPECT_EQ(row.act, Act::Hold);
  EXPECT_EQ(row.cycle, 24);
  EXPECT_NEAR(row.clock_s, 1000.2 + 1 + 2.407, 1e-9);
  EXPECT_NEAR(row.late_ms, 7, 1e-9);
  EXPECT_NEAR(row.sensed.time_s, 2.407, 1e-9);
  EXPECT_EQ(row.sensed.ground, (Rgb{10, 21, 30}));
  EXPECT_EQ(row.ground_as_sent, (RawColor{10, 20.6, 30}));
  EXPECT_EQ(row.age_ms, (PerFeed<std::optional<double>>{407, 17, 7, std::nullopt}));
  EXPECT_NEAR(row.stamp_ms[index_of(Feed::Ground)].value(), 12, 1e-6);
  EXPECT_EQ(row.stamp_ms[index_of(Feed::Neighbours)], std::nullopt);
}

TEST(RobotNode, CutsOneTreadAloneAndSaysSoBeforeAnOldReading) {
  const Flavour chocolate = find_flavour("chocolate", TurnClock::Cycles).value();
  BenchRobot robot({.max_mps = 0.2}, kLightMachine, chocolate);
  robot.light = true;
  robot.start();
  robot.cycle();
  EXPECT_EQ(robot.state().reasons,
            std::vector<std::string>{"speeds were cut to 0.2 m/s in 1 cycle"});
  robot.cycle();
  robot.ranges = false;
  robot.cycles(2);
  const LogRow& row = robot.rows.back();
  EXPECT_EQ(row.command.left_mps, 0.2);
  EXPECT_NEAR(row.command.right_mps, 0, 1e-12);
  EXPECT_EQ(row.sensed.light_lux, (EightReadings{0, 0, 0, 500, 0, 0, 0, 0}));
  EXPECT_THAT(row.event, AllOf(StartsWith("speeds cut from 0.3 and "), EndsWith(" m/s")))
      << "not that ranges are old";
  EXPECT_EQ(robot.state().reasons,
            std::vector<std::string>{"speeds were cut to 0.2 m/s in 4 cycles"});
}

TEST(RobotNode, AnOperatorMayBeSilentUpToItsLimits) {
  const auto silent_for = [](int ms) {
    BenchRobot robot;
    robot.start();
    robot.cycles(10);
    robot.alive = false;
    robot.cycles(ms / 100 - 1);
    robot.cycle(milliseconds(ms % 100));
    EXPECT_EQ(robot.state().phase, ms > 1000 ? Phase::Failed : Phase::Running);
    return robot.speed() > 0;
  };
  EXPECT_TRUE(silent_for(300));
  EXPECT_FALSE(silent_for(301));
  EXPECT_FALSE(silent_for(1000));
  EXPECT_FALSE(silent_for(1001));
}

/// A robot with cycles of 0.125 s, whose times are exact, after 16 s of a run, in which its
/// operator's clock is right until the last sign of life.
struct AfterDrift : BenchRobot {
  explicit AfterDrift(double last_ahead_s) : BenchRobot({.period = milliseconds(125)}) {
    cycles(2);
    node.hear(order(Order::Kind::Start), now());
    cycles(127);
    operator_ahead_s = last_ahead_s;
    cycle();
  }
};

TEST(RobotNode, AnOperatorsClockMayDriftByOnePartInAThousand) {
  const std::vector<std::string> none;
  // A message is valid for 1 s, and there is a drift of 0.016 s.
  EXPECT_EQ(AfterDrift(1.0155).state().reasons, none);
  EXPECT_EQ(AfterDrift(1.0165).state().reasons,
            std::vector<std::string>{"the operator's clock was stepped by +1.02 s at 15.0 s"});
  for (const double late_s : {1.0155, 1.0165}) {
    AfterDrift robot(-late_s);
    const bool counts = late_s == 1.0155;
    robot.alive = false;
    robot.cycles(2);
    EXPECT_EQ(robot.speed() > 0, counts);
    EXPECT_EQ(robot.state().reasons.empty(), counts);
    robot.cycle();
    EXPECT_EQ(robot.speed(), 0);
    EXPECT_EQ(robot.rows.back().event,
              counts ? "no message from the operator for 0.38 s"
                     : "the operator's orders have had times 1.02 s too early for 0.50 s: its "
                       "clock was set back, or the network delays them");
    robot.operator_ahead_s = 0;
    robot.alive = true;
    robot.cycle();
    EXPECT_GT(robot.speed(), 0);
    robot.alive = false;
    robot.cycles(3);
    EXPECT_EQ(robot.rows.back().event, "no message from the operator for 0.38 s");
  }
  AfterDrift robot(-0.9);  // a late message is not the reference for later ones
  robot.operator_ahead_s = 0.5;
  robot.cycle();
  EXPECT_EQ(robot.state().reasons, none);
  robot.operator_ahead_s = 1.25;  // but the prompt one before is
  robot.cycle();
  EXPECT_EQ(robot.state().reasons, none);
}

TEST(RobotNode, AClockIsSteppedIfItMovesByMoreThanATenthOfASecond) {
  for (const double step_s : {-0.11, -0.09, 0.0, 0.09, 0.11}) {
    BenchRobot robot;
    robot.wall_ahead_s = 3;  // before the run
    robot.operator_ahead_s = 3;
    robot.cycles(2);
    Order start = robot.order(Order::Kind::Start);
    start.at_unix_s += 3;
    robot.node.hear(start, robot.now());
    robot.cycles(20);
    robot.wall_ahead_s += step_s;
    robot.cycles(5);
    std::vector<std::string> reasons;
    std::string event;
    if (std::fabs(step_s) > 0.1) {
      event = fmt::format("this computer's clock was stepped by {:+.2f} s", step_s);
      reasons = {event + " at 1.1 s"};
    }
    EXPECT_EQ(robot.state().reasons, reasons);
    for (const LogRow& row : robot.rows)
      EXPECT_EQ(row.event, row.cycle == 11 ? event : "") << row.cycle;
  }
  BenchRobot robot;
  robot.start();
  robot.cycles(10);
  robot.ranges = false;
  robot.cycle();
  robot.wall_ahead_s = 1;
  robot.cycle();
  EXPECT_EQ(robot.rows.back().event,
            "proximity: silent for 0.20 s; this computer's clock was stepped by +1.00 s");
}

TEST(RobotNode, TellsForWhatTheTreadsStoodLongest) {
  BenchRobot robot({.operator_gone = std::chrono::seconds(2)});
  robot.start();
  robot.cycles(10);
  const auto silence = [&robot](bool BenchRobot::*part, int cycles) {
    robot.*part = false;
    robot.cycles(cycles);
    robot.*part = true;
    robot.cycles(10);
  };
  silence(&BenchRobot::alive, 4);
  silence(&BenchRobot::alive, 6);
  silence(&BenchRobot::alive, 5);
  silence(&BenchRobot::obeys, 4);
  const std::string of_operator =
      "the operator was silent, for up to 0.60 s, at 2.4 s: 6 cycles "
      "were not stepped";
  EXPECT_THAT(robot.state().reasons,
              ElementsAre(AllOf(StartsWith("driver: driver does not report what the treads do, for "
                                           "up to 0.40 s, at 5.5 s: "),
                                EndsWith("not stepped")),
                          of_operator));
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  robot.obeys = false;
  robot.cycles(15);
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_THAT(robot.state().reasons,
              ElementsAre(StartsWith("driver: driver does not report what the treads do (for "),
                          of_operator))
      << "the driver's reason comes once";
  EXPECT_EQ(robot.node.head().end->driver, RunVerdict::Invalid);
}

TEST(RobotNode, StopsOnlyARun) {
  BenchRobot robot;
  robot.cycle();
  robot.node.stop("by SIGTERM");
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  EXPECT_THAT(robot.state().reasons, IsEmpty());
  robot.seconds = 1;
  robot.start();
  robot.node.stop("by SIGTERM");
  EXPECT_THAT(robot.state().reasons, ElementsAre("stopped by SIGTERM")) << "before a cycle";
  robot.node.stop("again");
  EXPECT_THAT(robot.state().reasons, ElementsAre("stopped by SIGTERM"));
  robot.run = "run08";
  robot.start();
  Order stop = robot.order(Order::Kind::Stop);
  stop.run.clear();
  robot.cycle();
  robot.node.hear(stop, robot.now());
  EXPECT_THAT(robot.state().reasons, ElementsAre("stopped by order after 0.1 s of 1.0 s"));
}

TEST(RobotNode, InLockStepLogsWhatTheWorldSent) {
  const Flavour chocolate = find_flavour("chocolate", TurnClock::Cycles).value();
  BenchRobot robot({.max_mps = kMaxWheelSpeed_mps, .lock_step_run = "world"}, kLightMachine,
                   chocolate);
  SensesMessage message{.seed = 7, .cycle = 0};
  EXPECT_FALSE(value_of(robot.node.answer(message, robot.now())).command);
  EXPECT_EQ(robot.state().phase, Phase::Idle) << "there was no run to end";
  message = {.seed = 7,
             .cycle = 1,
             .time_s = 0.125,
             .ranges_m = {1, 2, 3, 4, 5, 6, 7, 8},
             .color = {-3, 127.9, 300},
             .light_lux = {0, 0, 0, 500, 0, 0, 0, 1},
             .neighbours = {{0.5, 0.6, -0.8}, {0.75, 1, 0}}};
  const Decision decision = value_of(robot.node.answer(message, robot.now()));
  LogRow row;
  row.cycle = 1;
  row.clock_s = 1000;
  row.command = decision.command.value();
  row.sensed = {.time_s = 0.125,
                .proximity_m = message.ranges_m,
                .ground = {0, 127, 255},
                .neighbours = {{0.5, 0.6, -0.8}, {0.75, 1, 0}},
                .light_lux = message.light_lux};
  row.ground_as_sent = {-3, 127.9, 300};
  EXPECT_EQ(text_of(decision.row.value()), text_of(row));
  EXPECT_GT(row.command.left_mps, row.command.right_mps) << "towards the light";
  const LogHead head = robot.node.head();
  EXPECT_EQ(head.run, "world-seed7");
  EXPECT_EQ(head.seconds, 0);
  EXPECT_TRUE(head.lock_step);
  robot.node.end_run();
  EXPECT_EQ(robot.node.head().end, (RunEnd{.state = "ended", .stepped = 1}));

  const auto complaint = [&](const char* wrong) {
    EXPECT_EQ(why_not(robot.node.answer(message, robot.now())).message, wrong);
    EXPECT_EQ(robot.state().phase, Phase::Failed);
    EXPECT_THAT(robot.state().reasons, ElementsAre(wrong));
  };
  message.cycle = 2;
  complaint("cycle 2 of seed 7 came, but no run is in progress");
  message.cycle = 1;
  EXPECT_TRUE(robot.node.answer(message, robot.now()));
  message = {.seed = 8, .cycle = 2};
  complaint("cycle 2 of seed 8 came after cycle 1 of seed 7");
  message.cycle = 0;
  EXPECT_TRUE(robot.node.answer(message, robot.now()));
  EXPECT_EQ(robot.state().phase, Phase::Failed) << "the run has not ended well";
}

TEST(RobotNode, StandsWhenItsMachineGivesNoSpeed) {
  BenchRobot robot({}, "--nstates 1 --s0 2 --att0 2");
  SensesMessage message{.seed = 7, .cycle = 1, .neighbours = {{std::nan(""), 1, 0}}};
  const Decision decision = value_of(robot.node.answer(message, robot.now()));
  Command red;
  red.leds.fill({255, 0, 0});
  EXPECT_EQ(decision.command, red);
  EXPECT_EQ(decision.row.value().command, red);
  EXPECT_EQ(decision.row->event, "the controller's speeds are not finite numbers");
  EXPECT_EQ(robot.state().phase, Phase::Failed);
  EXPECT_THAT(robot.state().reasons, ElementsAre("the controller's speeds are not finite numbers"));
  EXPECT_EQ(within_limits({-0.2, 0.5, {}}, 0.35), (Command{-0.2, 0.35, {}}));
  EXPECT_EQ(within_limits({0.5, -0.5, {}}, 0), (Command{}));
}

}  // namespace
}  // namespace swarmsmith
