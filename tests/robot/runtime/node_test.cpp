#include "robot/runtime/node.h"

#include <cmath>

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
  robot.cycles(6);
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
  ASSERT_EQ(robot.rows.size(), 1U);
  EXPECT_EQ(robot.rows[0].cycle, 1);
  EXPECT_NEAR(robot.rows[0].late_ms, 2, 1e-9);
  EXPECT_NEAR(robot.rows[0].sensed.time_s, 0.102, 1e-9);
  EXPECT_GT(robot.speed(), 0);
  robot.cycles(298);
  EXPECT_EQ(robot.state().phase, Phase::Running);
  robot.cycle();
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.speed(), 0);
  EXPECT_EQ(robot.rows.size(), 299U);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Valid)
      << testing::PrintToString(robot.state().reasons);
  EXPECT_EQ(robot.cycle().command, Command{}) << "zero until the state is left";
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

TEST(RobotNode, EndsTheRunWhenASensorIsSilentForASecond) {
  for (const Feed feed : {Feed::Proximity, Feed::Ground, Feed::Neighbours}) {
    BenchRobot robot;
    robot.start();
    robot.cycles(20);
    (feed == Feed::Proximity ? robot.ranges
     : feed == Feed::Ground  ? robot.ground
                             : robot.neighbours) = false;
    constexpr int until_held = 4;  // within 0.5 s, of whatever sensor
    robot.cycles(until_held - 1);
    EXPECT_GT(robot.speed(), 0) << name_of(feed);
    robot.cycle();
    EXPECT_EQ(robot.speed(), 0) << name_of(feed);
    robot.cycles(10 - until_held);
    EXPECT_EQ(robot.state().phase, Phase::Running);
    robot.cycle();
    EXPECT_EQ(robot.state().phase, Phase::Failed);
    EXPECT_EQ(robot.state().verdict, RunVerdict::Invalid);
    EXPECT_THAT(robot.state().reasons[0],
                HasSubstr(std::string(name_of(feed)) + ": silent for 1.10 s"));
    EXPECT_EQ(robot.speed(), 0);
  }
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
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("proximity sensor 1 (0 degrees) is missing"));
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
  robot.cycles(20);
  EXPECT_EQ(robot.state().phase, Phase::Ready);
  EXPECT_THAT(robot.state().refused, HasSubstr("read-only"));
  EXPECT_THAT(robot.rows, IsEmpty());
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
  for (int cycle = 1; cycle <= 3; ++cycle) {
    const Decision decision = robot.node.step_counted(robot.now());
    EXPECT_EQ(decision.row->cycle, cycle);
    EXPECT_NEAR(decision.row->sensed.time_s, 0.1 * cycle, 1e-12);
  }
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

}  // namespace
}  // namespace swarmsmith
