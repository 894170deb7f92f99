#include "robot/runtime/replay.h"

#include <algorithm>
#include <cmath>

#include "tests/robot/runtime/bench_robot.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::string network_text() {
  std::string text = "--network rvr --weights ";
  Rng rng(4);
  for (int i = 0; i < 26; ++i)
    text += (i == 0 ? "" : ",") + std::to_string(rng.uniform(-3, 3));
  return text;
}

/// A run of 20 s with changing readings, a silent sensor and skipped cycles.
RunRecord record_of(const std::string& machine, TurnClock turn_clock) {
  BenchRobot robot({.robot_index = 2, .seed = 11}, machine,
                   find_flavour("watermelon", turn_clock).value());
  robot.seconds = 20;
  robot.start();
  Rng rng(9);
  robot.ranges = robot.ground = false;
  for (int i = 0; i < 210; ++i) {
    if (i < 50 || i > 53) robot.send_ranges(rng.uniform(0.02, 0.6));
    robot.send_ground(rng.bernoulli(0.2) ? 0 : 127);
    if (i == 100) robot.clock += std::chrono::milliseconds(100);
    robot.cycle(std::chrono::microseconds(rng.below(30'000)));
  }
  EXPECT_EQ(robot.state().phase, Phase::Ended)
      << machine << testing::PrintToString(robot.state().reasons);
  return {robot.node.head(), robot.rows};
}

constexpr const char* kTree =
    "--nroot 3 --nchildroot 2 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 0.5 --n01 5 --a01 0 --rwm01 "
    "5 --p01 0 --n1 0 --nchild1 2 --n10 6 --c10 5 --p10 0.2 --n11 5 --a11 1 --p11 0";

TEST(LogReplay, GivesEachCommandOfEveryArchitectureAgain) {
  for (const std::string& machine :
       {std::string(kCuriousMachine), std::string(kTree), network_text()}) {
    for (const TurnClock clock : {TurnClock::Cycles, TurnClock::Seconds}) {
      const RunRecord record = record_of(machine, clock);
      const auto replay = value_of(replay_log(record));
      EXPECT_FALSE(replay.difference) << replay.difference->cycle << replay.difference->what;
      EXPECT_EQ(replay.stepped, record.head.end->stepped);
      EXPECT_GT(replay.stepped, 150);
      EXPECT_GT(record.head.end->held, 0);
    }
  }
}

TEST(LogReplay, PassesOverSpeedsThatAreNotNumbersIfTheTreadsStood) {
  RunRecord record = record_of("--nstates 1 --s0 2 --att0 2", TurnClock::Cycles);
  record.rows[40].sensed.neighbours = {{.distance_m = std::nan("")}};
  EXPECT_THAT(value_of(replay_log(record)).difference.value().what, HasSubstr("gives 0 and 0 m/s"));
  record.rows[40].command.left_mps = record.rows[40].command.right_mps = 0;
  const auto replay = value_of(replay_log(record));
  EXPECT_FALSE(replay.difference) << replay.difference->cycle << replay.difference->what;
  EXPECT_EQ(replay.stepped, record.head.end->stepped);
}

TEST(LogReplay, SaysAtWhichCycleSomethingDiffers) {
  const RunRecord record = record_of(kCuriousMachine, TurnClock::Cycles);
  const auto difference = [&record](const auto& change) {
    RunRecord changed = record;
    change(changed);
    return replay_log(changed).value().difference.value_or(LogReplay::Difference{});
  };
  const auto speeds = difference([](RunRecord& of) {
    of.rows[40].command.left_mps = std::nextafter(of.rows[40].command.left_mps, 1);
  });
  EXPECT_EQ(speeds.cycle, 41);
  EXPECT_THAT(speeds.what, HasSubstr("speeds"));
  EXPECT_GT(difference([](RunRecord& of) { of.head.seed = 12; }).cycle, 0);
  EXPECT_GT(difference([](RunRecord& of) { of.head.robot_index = 1; }).cycle, 0);
  EXPECT_THAT(difference([](RunRecord& of) { of.rows[40].state += 1; }).what, HasSubstr("state"));
  EXPECT_THAT(difference([](RunRecord& of) { of.rows[40].drawn += 1; }).what,
              HasSubstr("random numbers"));
  EXPECT_THAT(
      difference([](RunRecord& of) { of.rows.insert(of.rows.begin() + 41, of.rows[40]); }).what,
      HasSubstr("comes after"));
  for (double Command::*tread : {&Command::left_mps, &Command::right_mps}) {
    const auto moved = difference([tread](RunRecord& of) {
      std::ranges::find(of.rows, Act::Hold, &LogRow::act)->command.*tread = 0.1;
    });
    EXPECT_THAT(moved.what, HasSubstr("held"));
  }
}

TEST(LogReplay, RefusesAHeadThatCannotBeRead) {
  RunRecord record = record_of(kCuriousMachine, TurnClock::Cycles);
  record.head.flavour = "strawberry";
  EXPECT_FALSE(replay_log(record));
  record.head.flavour = "watermelon";
  record.head.turn_clock = "minutes";
  EXPECT_FALSE(replay_log(record));
  record.head.turn_clock = "cycles";
  record.head.machine = "--nstates 9";
  EXPECT_FALSE(replay_log(record));
}

}  // namespace
}  // namespace swarmsmith
