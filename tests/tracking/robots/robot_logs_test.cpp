#include "tracking/robots/robot_logs.h"

#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/rng.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr int kCycles = 600;
/// Of the robot's clock, when it begins.
constexpr double kBegin_s = 8123.25;

/// Straight and turning, for some cycles each; another robot does so at other times.
std::vector<Command> commands_of(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Command> commands;
  for (bool is_turning = false; commands.size() < std::size_t{kCycles}; is_turning = !is_turning) {
    const double side = rng.bernoulli(0.5) ? 0.3 : -0.3;
    const int cycles = static_cast<int>(rng.uniform(5, is_turning ? 12 : 30));
    for (int i = 0; i < cycles; ++i) {
      Command& command = commands.emplace_back();
      command.left_mps = is_turning ? -side : 0.3;
      command.right_mps = is_turning ? side : 0.3;
    }
  }
  return commands;
}

RobotLog log_of(const std::string& robot, std::uint64_t seed = 1) {
  const std::vector<Command> commands = commands_of(seed);
  RobotLog log{robot, "run07." + robot + ".log.csv", {}};
  LogHead& head = log.record.head;
  head.run = "run07";
  head.robot = robot;
  head.machine = "--nstates 1 --s0 1";
  head.machine_digest = "aa11";
  head.flavour = "watermelon";
  head.start_clock_s = kBegin_s;
  head.seconds = 60;
  head.end = RunEnd{.state = "ended", .stepped = kCycles};
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    LogRow& row = log.record.rows.emplace_back();
    row.cycle = cycle;
    row.sensed.time_s = cycle * 0.1;
    row.clock_s = kBegin_s + cycle * 0.1;
    row.command = commands[static_cast<std::size_t>(cycle - 1)];
  }
  return log;
}

/// A robot that did what the log commands, `latency_s` later, seen 30 times a second.
TrackedRobot moved_by(const RobotLog& log, double latency_s) {
  TrackedRobot robot;
  robot.name = log.robot;
  Rng noise(7);
  Pose pose;
  constexpr double kStep_s = 1.0 / 300;
  for (int step = 0; step < 300 * 61; ++step) {
    const double time_s = step * kStep_s;
    if (step % 10 == 0) {
      Sample sample;
      sample.time_s = time_s;
      sample.pose = {pose.x + noise.normal(0, 0.0003), pose.y + noise.normal(0, 0.0003),
                     pose.theta + noise.normal(0, 0.003)};
      robot.samples.push_back(sample);
    }
    const auto cycle = static_cast<std::int64_t>(std::floor((time_s - latency_s) * 10 + 1e-6));
    if (cycle < 1) continue;
    const auto row =
        std::ranges::find(log.record.rows, std::min<std::int64_t>(cycle, kCycles), &LogRow::cycle);
    if (row == log.record.rows.end()) continue;
    const Command& told = row->command;
    pose.x += (told.left_mps + told.right_mps) / 2 * kStep_s * std::cos(pose.theta);
    pose.y += (told.left_mps + told.right_mps) / 2 * kStep_s * std::sin(pose.theta);
    pose.theta += (told.right_mps - told.left_mps) / 0.147 * kStep_s;
  }
  return robot;
}

/// Two robots that did as they were told.
struct RobotLogsTest : testing::Test {
  std::vector<RobotLog> logs{log_of("rvr1"), log_of("rvr2", 2)};
  TrackedRun run;
  RunLog log;

  RobotLogsTest() {
    run.robots = {moved_by(logs[0], 0.06), moved_by(logs[1], 0.2)};
    log.name = "run07";
    log.mission.cycles = kCycles;
    log.notes = {{"rvr1", logs[0].file, Verdict::Valid, {}},
                 {"rvr2", logs[1].file, Verdict::Valid, {}}};
  }
  RobotFindings judged() const { return judge_robots(run, logs, log); }
};

MATCHER_P3(Is, code, robot, text, "") {
  return arg.code == code && arg.robot == robot && arg.text.find(text) != std::string::npos;
}

TEST_F(RobotLogsTest, OfAGoodRunGiveTheLatenciesAndNothingElse) {
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues, IsEmpty());
  ASSERT_EQ(found.latencies.size(), 2U);
  EXPECT_NEAR(found.latencies[0]->seconds.value(), 0.06, 0.01);
  EXPECT_NEAR(found.latencies[1]->seconds.value(), 0.2, 0.01);
}

TEST_F(RobotLogsTest, OfNoRobotSayNothing) {
  logs.clear();
  log.notes.clear();
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues, IsEmpty());
  ASSERT_EQ(found.latencies.size(), 2U);
  EXPECT_FALSE(found.latencies[0] || found.latencies[1]);
}

/// Of the robots' logs, by name and robot.
const Check* check_of(const std::vector<Check>& checks, std::string_view name,
                      std::string_view robot) {
  const auto found = std::ranges::find_if(
      checks, [&](const Check& check) { return check.name == name && check.subject == robot; });
  return found == checks.end() ? nullptr : &*found;
}

TEST_F(RobotLogsTest, AreAskedTheSameOfEachRobotWithNumbersAndLimits) {
  logs[1].record.head.clock_offset_s = 0.045;
  Observations seen;
  seen.logs = logs;
  const std::vector<Check> checks = checks_of_logs(run, seen, log, judged());
  EXPECT_EQ(checks.size(), 16U);
  const Check* motion = check_of(checks, "motion as commanded", "rvr1");
  ASSERT_NE(motion, nullptr);
  EXPECT_EQ(motion->outcome, Check::Outcome::Passed);
  EXPECT_GT(motion->value.value(), 0.9);
  EXPECT_EQ(motion->limit, kLeastAgreement);
  const Check* clock = check_of(checks, "clock of the robot", "rvr2");
  EXPECT_EQ(clock->outcome, Check::Outcome::Warned);
  EXPECT_NEAR(clock->value.value(), 45, 1e-9);
  EXPECT_EQ(clock->limit, 20);
}

TEST_F(RobotLogsTest, SayForHowLongTheDriverDidNotObey) {
  Observations seen;
  const auto asked = [&](std::optional<bool> driven, RunVerdict driver, double off_s) {
    RunEnd& end = *logs[0].record.head.end;
    end.driven = driven;
    end.driver = driver;
    end.driver_off_s = off_s;
    seen.logs = logs;
    return *check_of(checks_of_logs(run, seen, log, judged()), "driver watched", "rvr1");
  };
  const Check obeys = asked(true, RunVerdict::Valid, 0.13);
  EXPECT_EQ(obeys.outcome, Check::Outcome::Passed);
  EXPECT_EQ(value_text(obeys) + ", " + limit_text(obeys), "0.13 s, at most 0.3 s");
  const Check held = asked(true, RunVerdict::Degraded, 0.62);
  EXPECT_EQ(held.outcome, Check::Outcome::Warned);
  EXPECT_EQ(value_text(held) + ", " + limit_text(held), "0.62 s, at most 0.3 s");
  const Check gone = asked(true, RunVerdict::Invalid, 1.08);
  EXPECT_EQ(gone.outcome, Check::Outcome::Failed);
  EXPECT_EQ(value_text(gone) + ", " + limit_text(gone), "1.08 s, at most 1 s");
  const Check late = asked(true, RunVerdict::Invalid, 0.2);
  EXPECT_EQ(late.outcome, Check::Outcome::Failed);
  EXPECT_EQ(value_text(late), "") << "that is not why";
  const Check quiet = asked(false, RunVerdict::Valid, 0);
  EXPECT_EQ(quiet.outcome, Check::Outcome::NotRun);
  EXPECT_EQ(quiet.reason, "its driver did not say what the treads do (`driven`)");
  const Check old = asked(std::nullopt, RunVerdict::Valid, 0);
  EXPECT_EQ(old.outcome, Check::Outcome::NotRun);
  EXPECT_THAT(old.reason, HasSubstr("it is an older one"));
  logs[0].record.head.end.reset();
  seen.logs = logs;
  EXPECT_EQ(check_of(checks_of_logs(run, seen, log, judged()), "driver watched", "rvr1")->reason,
            "its log has no end");
}

TEST_F(RobotLogsTest, ThatAreNotThereOrNotOfThisRunAreSaid) {
  Observations seen;
  log.notes[0] = {"rvr1", "", std::nullopt, {}};
  seen.issues = {{IssueCode::LogForeign, "rvr2: its log is of run run06", "rvr2", {}, {}}};
  logs.clear();
  log.notes[1].verdict.reset();
  const std::vector<Check> checks = checks_of_logs(run, seen, log, judged());
  EXPECT_EQ(checks.size(), 16U);
  for (const char* name :
       {"log of this run", "end of the robot's log", "clock of the robot", "motion as commanded",
        "robot's own verdict", "driver watched", "latency of the treads", "way of what was told"}) {
    const Check* of_first = check_of(checks, name, "rvr1");
    ASSERT_NE(of_first, nullptr) << name;
    EXPECT_EQ(of_first->outcome, Check::Outcome::NotRun) << name;
    EXPECT_FALSE(of_first->reason.empty()) << name;
  }
  EXPECT_EQ(check_of(checks, "log of this run", "rvr2")->outcome, Check::Outcome::Failed);
  EXPECT_EQ(check_of(checks, "motion as commanded", "rvr2")->reason, "its log is not of this run");
}

TEST_F(RobotLogsTest, TheWorseOfBothVerdictsCountsWithAllReasons) {
  logs[0].record.head.end->verdict = RunVerdict::Degraded;
  logs[0].record.head.end->reasons = {"1.5 % of the cycles were skipped", "proximity was silent"};
  log.notes[0].reasons = {"proximity was silent"};
  log.notes[1].verdict = Verdict::Invalid;
  log.notes[1].reasons = {"it did not answer after the run"};
  EXPECT_THAT(
      judged().issues,
      ElementsAre(Is(IssueCode::RobotDegraded, "rvr1",
                     "rvr1: its node says that its run is DEGRADED: 1.5 % of the cycles "
                     "were skipped; proximity was silent"),
                  Is(IssueCode::RobotInvalid, "rvr2", "INVALID: it did not answer after the run")));
}

TEST_F(RobotLogsTest, ANodesVerdictCountsWithoutItsLog) {
  logs.erase(logs.begin());
  log.notes[0].verdict = Verdict::Degraded;
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues,
              ElementsAre(Is(IssueCode::RobotDegraded, "rvr1", "it gives no reason")));
  EXPECT_FALSE(found.latencies[0]);
  EXPECT_TRUE(found.latencies[1]);
}

TEST_F(RobotLogsTest, ALogThatEndsEarlyIsSaidWithBothTimes) {
  logs[1].record.rows.resize(400);
  EXPECT_THAT(judged().issues,
              ElementsAre(Is(IssueCode::LogShort, "rvr2", "rvr2: its log ends at 40.0 s of 60 s")));
  EXPECT_EQ(judged().issues[0].from, 40.0);
  // A second is lost when a node is killed at the end.
  logs[1] = log_of("rvr2", 2);
  logs[1].record.rows.resize(kCycles - 10);
  EXPECT_THAT(judged().issues, IsEmpty());
  logs[1].record.rows.clear();
  EXPECT_THAT(judged().issues, Contains(Is(IssueCode::LogShort, "rvr2", "ends at 0.0 s")));
}

TEST_F(RobotLogsTest, ALogWithoutAnEndIsJudgedByItsRows) {
  log.notes.clear();
  logs[0].record.head.end.reset();
  EXPECT_THAT(judged().issues, ElementsAre(Is(IssueCode::RobotDegraded, "rvr1", "killed")));
  logs[0].record.rows.erase(logs[0].record.rows.begin() + 50, logs[0].record.rows.begin() + 62);
  EXPECT_THAT(judged().issues,
              ElementsAre(Is(IssueCode::RobotDegraded, "rvr1",
                             "12 of 600 cycles were skipped or held (2.0 %, at most 1 %")));
  for (int i = 100; i < 130; ++i)
    logs[0].record.rows[static_cast<std::size_t>(i)].act = Act::Hold;
  EXPECT_THAT(judged().issues, ElementsAre(Is(IssueCode::RobotInvalid, "rvr1",
                                              "42 of 600 cycles were skipped or held (7.0 %, at "
                                              "most 5 %")));
  const LogCounts counts = log_counts(logs[0].record);
  EXPECT_EQ(counts.skipped, 12);
  EXPECT_EQ(counts.held, 30);
  EXPECT_EQ(counts.stepped, 558);
}

TEST_F(RobotLogsTest, AClockThatIsOffIsSaidAndTakenOutOfTheLatency) {
  logs[0].record.head.clock_offset_s = -0.015;
  EXPECT_THAT(judged().issues, IsEmpty());
  EXPECT_NEAR(judged().latencies[0]->seconds.value(), 0.045, 0.015);
  logs[0].record.head.clock_offset_s = 0.035;
  EXPECT_THAT(judged().issues,
              ElementsAre(Is(IssueCode::ClockOffset, "rvr1",
                             "its clock was 35 ms ahead of the operator's (at most 20 ms): it "
                             "began earlier")));
  EXPECT_NEAR(judged().latencies[0]->seconds.value(), 0.095, 0.015);
}

TEST_F(RobotLogsTest, SwappedLogsAreSeenInTheMotion) {
  std::swap(logs[0].record.rows, logs[1].record.rows);
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues, ElementsAre(Is(IssueCode::MotionUnlikeLog, "rvr1", "swapped"),
                                        Is(IssueCode::MotionUnlikeLog, "rvr2", "swapped")));
  EXPECT_FALSE(found.latencies[0]->seconds);
}

TEST_F(RobotLogsTest, TreadsThatActLateAreSeenWhateverTheirDriverSays) {
  run.robots[0] = moved_by(logs[0], 0.33);
  EXPECT_THAT(judged().issues, IsEmpty());
  run.robots[0] = moved_by(logs[0], 0.6);
  Observations seen;
  seen.logs = logs;
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues, ElementsAre(Is(IssueCode::MotionUnlikeLog, "rvr1",
                                           "ms after its commands (at most "
                                           "350 ms)")));
  const std::vector<Check> checks = checks_of_logs(run, seen, log, found);
  const Check* late = check_of(checks, "latency of the treads", "rvr1");
  ASSERT_NE(late, nullptr);
  EXPECT_EQ(late->outcome, Check::Outcome::Warned);
  EXPECT_NEAR(late->value.value(), 600, 10);
  EXPECT_EQ(check_of(checks, "latency of the treads", "rvr2")->outcome, Check::Outcome::Passed);
}

TEST_F(RobotLogsTest, TreadsThatMayBeInTimeHaveTheLimitOfThoseThatAreLate) {
  RobotFindings found = judged();
  ASSERT_TRUE(found.reality.at(0).has_value());
  found.reality[0]->latency.seconds = 0.36;
  found.reality[0]->latency.error_s = 0.01;
  found.reality[0]->slip.way = {.gain = 1.31, .error = 0.02};
  Observations seen;
  seen.logs = logs;
  const std::vector<Check> asked = checks_of_logs(run, seen, log, found);
  const Check* latency = check_of(asked, "latency of the treads", "rvr1");
  ASSERT_NE(latency, nullptr);
  EXPECT_EQ(latency->outcome, Check::Outcome::Passed);
  EXPECT_EQ(value_text(*latency) + ", " + limit_text(*latency), "360 ms, at most 350 ms");
  const Check* way = check_of(asked, "way of what was told", "rvr1");
  ASSERT_NE(way, nullptr);
  EXPECT_EQ(way->outcome, Check::Outcome::Passed);
  EXPECT_EQ(limit_text(*way), "at most 30 % off");
}

TEST_F(RobotLogsTest, TreadsOfAnotherSpeedAreSeenWhateverTheirDriverSays) {
  for (LogRow& row : logs[0].record.rows) {
    row.command.left_mps *= 2;
    row.command.right_mps *= 2;
  }
  run.starts = {{0, 0, 0}, {9, 9, 0}};  // far from each other: both are free
  run.trajectory.robots = 2;
  for (int i = 0; i < kCycles; ++i)
    run.trajectory.poses.insert(run.trajectory.poses.end(), run.starts.begin(), run.starts.end());
  Observations seen;
  seen.logs = logs;
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues,
              ElementsAre(Is(IssueCode::MotionUnlikeLog, "rvr1",
                             "it drives 50 % of the way that is commanded (70 to 130 %")));
  const std::vector<Check> checks = checks_of_logs(run, seen, log, found);
  const Check* way = check_of(checks, "way of what was told", "rvr1");
  ASSERT_NE(way, nullptr);
  EXPECT_EQ(way->outcome, Check::Outcome::Warned);
  EXPECT_NEAR(way->value.value(), 50, 1);
  EXPECT_EQ(check_of(checks, "way of what was told", "rvr2")->outcome, Check::Outcome::Passed);
}

TEST_F(RobotLogsTest, ATagThatIsTurnedHalfRoundDrivesAgainstItsCommands) {
  run.starts = {{0, 0, 0}, {9, 9, 0}};  // far from each other: both are free
  run.trajectory.robots = 2;
  for (int i = 0; i < kCycles; ++i)
    run.trajectory.poses.insert(run.trajectory.poses.end(), run.starts.begin(), run.starts.end());
  for (Sample& sample : run.robots[0].samples)
    sample.pose.theta += kPi;
  Observations seen;
  seen.logs = logs;
  EXPECT_THAT(judged().issues, IsEmpty()) << "nothing says how its tag is turned on it";
  run.robots[0].has_heading = true;
  const RobotFindings found = judged();
  EXPECT_THAT(found.issues, ElementsAre(Is(IssueCode::TagTurned, "rvr1", "drive back")));
  const std::vector<Check> checks = checks_of_logs(run, seen, log, found);
  EXPECT_EQ(check_of(checks, "way of what was told", "rvr1")->outcome, Check::Outcome::Failed);
  EXPECT_EQ(check_of(checks, "way of what was told", "rvr2")->outcome, Check::Outcome::Passed);
}

TEST_F(RobotLogsTest, MotionBeforeItsCommandsAsksForTheStart) {
  for (TrackedRobot& robot : run.robots) {
    for (Sample& sample : robot.samples)
      sample.time_s -= 0.3;
  }
  EXPECT_THAT(judged().issues,
              ElementsAre(Is(IssueCode::MotionUnlikeLog, "rvr1",
                             "ms before its commands; is the start of the run right?"),
                          Is(IssueCode::MotionUnlikeLog, "rvr2", "before its commands")));
}

TEST_F(RobotLogsTest, OfAnotherRunRobotMachineOrWorldAreForeign) {
  const RanMachine machine{"--nstates 1 --s0 1", "watermelon"};
  EXPECT_FALSE(misfit_of(logs[0], log, machine));
  EXPECT_FALSE(misfit_of(logs[0], log, std::nullopt));
  const auto misfit = [&](const auto& change) {
    RobotLog changed = log_of("rvr1");
    change(changed.record);
    const auto issue = misfit_of(changed, log, machine);
    EXPECT_TRUE(issue);
    if (!issue) return std::string();
    EXPECT_EQ(issue->code, IssueCode::LogForeign);
    EXPECT_THAT(issue->text, HasSubstr("rvr1: its log run07.rvr1.log.csv"));
    EXPECT_THAT(issue->text, HasSubstr("it was left out"));
    return issue->text;
  };
  EXPECT_THAT(misfit([](RunRecord& record) { record.head.run = "run06"; }),
              HasSubstr("is of run run06, this is run07"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.head.robot = "rvr3"; }),
              HasSubstr("is of robot rvr3"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.head.machine = "--nstates 1 --s0 0"; }),
              HasSubstr("is of the machine `--nstates 1 --s0 0`, and `--nstates 1 --s0 1` should"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.head.flavour = "chocolate"; }),
              HasSubstr("flavour chocolate, and one of watermelon should have run"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.head.lock_step = true; }),
              HasSubstr("stepped by a simulated world"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.rows[7].cycle = 3; }),
              HasSubstr("has cycle 3 after cycle 7"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.rows[9].clock_s -= 100; }),
              HasSubstr("do not increase"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.rows.back().clock_s = 1e12; }),
              HasSubstr("has cycle 600 at a time that is not of this run"));
  EXPECT_THAT(misfit([](RunRecord& record) {
                record.rows.back().clock_s = std::numeric_limits<double>::infinity();
              }),
              HasSubstr("has cycle 600 at a time"));
  EXPECT_THAT(misfit([](RunRecord& record) {
                record.rows.back().sensed.time_s = 1e12;
                record.rows.back().clock_s = 1e12 + kBegin_s;
              }),
              HasSubstr("has cycle 600 at a time"));
  EXPECT_THAT(misfit([](RunRecord& record) { record.rows.front().clock_s = -1e12; }),
              HasSubstr("has cycle 1 at a time"));
  EXPECT_FALSE(other_machine(logs[1], logs[0]));
  logs[1].record.head.machine_digest = "bb22";
  const auto other = value_of(other_machine(logs[1], logs[0]));
  EXPECT_THAT(other.text, HasSubstr("digest bb22, and rvr1 ran one with aa11"));
}

}  // namespace
}  // namespace swarmsmith
