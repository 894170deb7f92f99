#include "robot/log/log_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/rng.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LogHead example_head() {
  return {.run = "run07",
          .robot = "rvr1",
          .robot_index = 2,
          .machine = "--nstates 1 --s0 1",
          .machine_digest = "0123456789abcdef0123456789abcdef",
          .flavour = "watermelon",
          .turn_clock = "seconds",
          .seed = 2147483647,
          .seconds = 120,
          .max_mps = 0.35,
          .program = "swarmsmith-robot 0.1.0",
          .host = "raspberry \"one\"",
          .scheduling = "SCHED_FIFO 20",
          .topics = {{"ground_color", "/rvr/ground_color"}, {"ranges", "/ranges"}},
          .start_clock_s = 12345.000000123,
          .start_unix_s = 1795000000.25,
          .clock_offset_s = -0.0031,
          .end = RunEnd{.state = "ended",
                        .verdict = RunVerdict::Degraded,
                        .reasons = {"14 of 1200 cycles skipped", "line\nbreak"},
                        .stepped = 1186,
                        .held = 0,
                        .skipped = 14,
                        .driven = true,
                        .driver = RunVerdict::Degraded,
                        .driver_off_s = 0.625}};
}

/// A row of arbitrary numbers.
LogRow random_row(Rng& rng) {
  const auto number = [&rng] {
    return std::ldexp(rng.uniform() - 0.5, static_cast<int>(rng.below(40)) - 20);
  };
  LogRow row;
  row.cycle = static_cast<std::int64_t>(rng.below(100000));
  row.clock_s = 1e6 * rng.uniform();
  row.late_ms = number();
  row.act = rng.bernoulli(0.5) ? Act::Hold : Act::Step;
  row.state = static_cast<int>(rng.below(4));
  row.command = {number(), number(), {}};
  if (rng.bernoulli(0.5))
    row.command.leds.fill({255, 0, static_cast<std::uint8_t>(rng.below(256))});
  row.sensed.time_s = number();
  for (double& distance : row.sensed.proximity_m)
    distance = rng.bernoulli(0.3) ? (rng.bernoulli(0.5) ? kInfinity : -kInfinity) : number();
  row.sensed.ground = {1, 2, static_cast<std::uint8_t>(rng.below(256))};
  for (std::uint64_t i = rng.below(4); i > 0; --i)
    row.sensed.neighbours.push_back({number(), number(), -0.0});
  if (rng.bernoulli(0.5)) row.sensed.light_lux.fill(number());
  row.ground_as_sent = {number(), number(), number()};
  for (std::size_t i = 0; i < kFeeds; ++i) {
    if (rng.bernoulli(0.7)) row.age_ms[i] = number();
    if (rng.bernoulli(0.5)) row.stamp_ms[i] = number();
  }
  row.drawn = rng.next();
  if (rng.bernoulli(0.3)) row.event = "proximity, \"3\": silent\nfor 312 ms";
  return row;
}

std::string first_error(const auto& read) {
  return read ? "none" : to_string(read.error().front());
}

/// Digits read back to the same bits (HasItsBytes), so that equal texts are equal rows.
TEST(LogText, GivesBackEveryRowBitByBit) {
  Rng rng(3);
  std::string text = log_columns();
  for (int i = 0; i < 500; ++i)
    text += log_line(random_row(rng));
  const auto read = parse_log_rows(text, "a.log.csv");
  ASSERT_TRUE(read) << first_error(read);
  std::string again = log_columns();
  for (const LogRow& row : *read)
    again += log_line(row);
  EXPECT_EQ(again, text);
}

TEST(LogText, GivesBackTheHead) {
  LogHead head = example_head();
  auto read = parse_log_head(log_head_text(head), "a.toml");
  ASSERT_TRUE(read) << first_error(read);
  EXPECT_EQ(*read, head);
  head.end.reset();
  head.clock_offset_s.reset();
  head.topics.clear();
  read = parse_log_head(log_head_text(head), "a.toml");
  ASSERT_TRUE(read) << first_error(read);
  EXPECT_EQ(*read, head);
}

/// As version 0.1.0 wrote them: logs of runs are kept for years.
TEST(LogText, HasTheRobotIfItIsNotTheRvr) {
  LogHead head = example_head();
  EXPECT_EQ(log_head_text(head).find("own_robot"), std::string::npos);
  head.own_robot = "[robot]\nname = \"rover\"\n";
  EXPECT_EQ(parse_log_head(log_head_text(head), "x").value(), head);
}

TEST(LogText, HasItsBytes) {
  EXPECT_EQ(
      log_columns(),
      "cycle,time_s,clock_s,late_ms,act,state,left_mps,right_mps,leds,prox0,prox1,prox2,prox3,"
      "prox4,prox5,prox6,prox7,r,g,b,raw_r,raw_g,raw_b,neighbours,light,age_proximity_ms,"
      "age_ground_ms,age_neighbours_ms,age_light_ms,stamp_proximity_ms,stamp_ground_ms,"
      "stamp_neighbours_ms,stamp_light_ms,drawn,event\n");
  EXPECT_EQ(log_line({}), "0,0,0,0,step,0,0,0,,0,0,0,0,0,0,0,0,0,0,0,0,0,0,,,,,,,,,,,0,\n");
  LogRow row{.cycle = 7,
             .clock_s = 1e6 / 3,
             .late_ms = -0.0,
             .act = Act::Hold,
             .state = 3,
             .command = {0.1, -0.25, {}},
             .sensed = {.time_s = 0.7,
                        .proximity_m = {kInfinity, -kInfinity, 0.3, 0, 1e-5, 1, 2, 3},
                        .ground = {1, 2, 255},
                        .neighbours = {{0.5, 1, -0.0}, {0.25, 0, 1}}},
             .ground_as_sent = {0.1, 0.2, 0.3},
             .age_ms = {1.5, std::nullopt, 3, 4},
             .stamp_ms = {std::nullopt, 2, std::nullopt, -4},
             .drawn = 18'446'744'073'709'551'615U,
             .event = "proximity, \"3\": silent\nfor 312 ms"};
  row.command.leds.fill({255, 0, 17});
  row.sensed.light_lux.fill(12.5);
  EXPECT_EQ(
      log_line(row),
      "7,0.7,333333.3333333333,-0,hold,3,0.1,-0.25,ff0011ff0011ff0011ff0011ff0011,inf,-inf,"
      "0.3,0,1e-05,1,2,3,1,2,255,0.1,0.2,0.3,0.5 1 -0 0.25 0 1,12.5 12.5 12.5 12.5 12.5 12.5 "
      "12.5 12.5,1.5,,3,4,,2,,-4,18446744073709551615,\"proximity, \"\"3\"\": silent\nfor 312 "
      "ms\"\n");
  EXPECT_EQ(log_head_text(example_head()), R"(format = 1
kind = "robot log"
run = "run07"
robot = "rvr1"
robot_index = 2
machine = "--nstates 1 --s0 1"
machine_digest = "0123456789abcdef0123456789abcdef"
flavour = "watermelon"
turn_clock = "seconds"
seed = 2147483647
lock_step = false
period_s = 0.1
seconds = 120
max_mps = 0.35
program = "swarmsmith-robot 0.1.0"
host = "raspberry \"one\""
scheduling = "SCHED_FIFO 20"
start_clock_s = 12345.000000123
start_unix_s = 1795000000.25
clock_offset_s = -0.0031

[topics]
ground_color = "/rvr/ground_color"
ranges = "/ranges"

[end]
state = "ended"
verdict = "DEGRADED"
reasons = ["14 of 1200 cycles skipped", "line\nbreak"]
stepped = 1186
held = 0
skipped = 14
driven = true
driver = "DEGRADED"
driver_off_s = 0.625
)");
}

TEST(LogText, LeavesOutTheRowThatWasBeingWritten) {
  Rng rng(4);
  const std::string whole = log_columns() + log_line(random_row(rng));
  const std::string next = log_line(random_row(rng));
  for (std::size_t cut = 0; cut < next.size() && next[cut] != '\n'; ++cut) {
    const auto read = parse_log_rows(whole + next.substr(0, cut), "a.log.csv");
    ASSERT_TRUE(read) << cut << ": " << first_error(read);
    EXPECT_EQ(read->size(), 1U);
  }
}

TEST(LogText, SaysWhatIsWrongAndWhere) {
  LogRow row;
  std::string line = log_line(row);
  EXPECT_THAT(first_error(parse_log_rows("cycle,x\n", "a.log.csv")),
              testing::StartsWith("a.log.csv:1: this is not the headline"));
  EXPECT_THAT(first_error(parse_log_rows(log_columns() + "1,2\n", "a.log.csv")),
              testing::AllOf(testing::StartsWith("a.log.csv:2:"), testing::HasSubstr("fields")));
  line.replace(line.find("step"), 4, "jump");
  EXPECT_EQ(first_error(parse_log_rows(log_columns() + line, "a.log.csv")),
            "a.log.csv:2: column act: expected `step` or `hold`, found `jump`");
  line = log_line(row);
  line[0] = 'x';
  EXPECT_EQ(first_error(parse_log_rows(log_columns() + line, "a.log.csv")),
            "a.log.csv:2: column cycle: expected an integer in its range, found `x`");
  std::string head = log_head_text(example_head());
  EXPECT_THAT(first_error(parse_log_head("format = 1\nname = \"x\"\n", "a.toml")),
              testing::HasSubstr("a.toml"));
  head.replace(head.find("DEGRADED"), 8, "GOOD");
  EXPECT_THAT(first_error(parse_log_head(head, "a.toml")), testing::HasSubstr("verdict"));
}

}  // namespace
}  // namespace swarmsmith
