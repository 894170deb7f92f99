#include "robot/runtime/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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
RunRecord record_of(const std::string& machine, const Flavour& flavour) {
  BenchRobot robot({.robot_index = 2, .seed = 11}, machine, flavour);
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

RunRecord record_of(const std::string& machine, TurnClock turn_clock) {
  return record_of(machine, find_flavour("watermelon", turn_clock).value());
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
    const auto found = value_of(replay_log(changed)).difference.value_or(LogReplay::Difference{});
    return std::to_string(found.cycle) + ": " + found.what;
  };
  const LogRow& row = record.rows[40];
  ASSERT_EQ(row.cycle, 41);
  for (double Command::*tread : {&Command::left_mps, &Command::right_mps}) {
    LogRow changed = row;
    changed.command.*tread = std::nextafter(changed.command.*tread, 1);
    EXPECT_EQ(difference([&](RunRecord& of) { of.rows[40] = changed; }),
              fmt::format("41: the log has the speeds {} and {} m/s, the controller gives {} and "
                          "{} m/s",
                          changed.command.left_mps, changed.command.right_mps, row.command.left_mps,
                          row.command.right_mps));
  }
  EXPECT_EQ(difference([](RunRecord& of) { of.rows[40].command.leds[3].b += 1; }),
            "41: other LEDs than the controller's");
  EXPECT_EQ(
      difference([](RunRecord& of) { of.rows[40].state += 1; }),
      fmt::format("41: the log has state {}, the controller is in {}", row.state + 1, row.state));
  EXPECT_EQ(difference([](RunRecord& of) { of.rows[40].drawn += 1; }),
            fmt::format("41: the log has {} random numbers, the controller drew {}", row.drawn + 1,
                        row.drawn));
  EXPECT_NE(difference([](RunRecord& of) { of.head.seed = 12; }), "0: ");
  EXPECT_NE(difference([](RunRecord& of) { of.head.robot_index = 1; }), "0: ");
  EXPECT_NE(difference([](RunRecord& of) { of.head.max_mps = 0.1; }), "0: ");
  EXPECT_EQ(difference([](RunRecord& of) { of.rows.insert(of.rows.begin() + 41, of.rows[40]); }),
            "41: cycle 41 comes after cycle 41");
  EXPECT_EQ(difference([](RunRecord& of) { of.rows[0].cycle = 0; }),
            "0: cycle 0 comes after cycle 0");
  for (double Command::*tread : {&Command::left_mps, &Command::right_mps}) {
    const auto cycle = std::ranges::find(record.rows, Act::Hold, &LogRow::act)->cycle;
    EXPECT_EQ(difference([tread](RunRecord& of) {
                std::ranges::find(of.rows, Act::Hold, &LogRow::act)->command.*tread = 0.1;
              }),
              std::to_string(cycle) + ": a cycle that was held has a speed");
  }
}

TEST(LogReplay, HasTheFlavourOfItsHead) {
  Flavour mine = watermelon();
  mine.name = "mine";
  mine.neighbours.attraction_gain = 3;
  RunRecord record;
  for (const TurnClock clock : {TurnClock::Seconds, TurnClock::Cycles}) {
    mine.exploration.turn_clock = clock;
    record = record_of(kCuriousMachine, mine);
    ASSERT_FALSE(record.head.own_flavour.empty());
    const auto replay = value_of(replay_log(record));
    EXPECT_FALSE(replay.difference) << replay.difference->what;
    EXPECT_EQ(replay.stepped, record.head.end->stepped);
  }
  record.head.own_flavour = "wings = 2\n";
  EXPECT_THAT(why_not(replay_log(record)).message, HasSubstr("begin with its format"));
}

TEST(LogReplay, RefusesAHeadThatCannotBeRead) {
  const LogHead head = record_of(kCuriousMachine, TurnClock::Cycles).head;
  const auto refusal = [&head](std::string LogHead::*part, const char* text) {
    RunRecord record{head, {}};
    EXPECT_TRUE(replay_log(record));
    record.head.*part = text;
    return why_not(replay_log(record)).message;
  };
  EXPECT_THAT(refusal(&LogHead::flavour, "strawberry"), HasSubstr("strawberry"));
  EXPECT_EQ(refusal(&LogHead::turn_clock, "minutes"),
            "there is no turn clock `minutes`; known are cycles and seconds");
  EXPECT_THAT(refusal(&LogHead::machine, "--nstates 9"), Not(IsEmpty()));
  EXPECT_THAT(refusal(&LogHead::own_robot, "wings = 2\n"),
              StartsWith("`own_robot` is not a robot: "));
}

}  // namespace
}  // namespace swarmsmith
