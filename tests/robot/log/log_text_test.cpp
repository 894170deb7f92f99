#include "robot/log/log_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
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

void expect_same_bits(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " " << b;
}

void expect_same(const LogRow& a, const LogRow& b) {
  EXPECT_EQ(a.cycle, b.cycle);
  EXPECT_EQ(a.act, b.act);
  EXPECT_EQ(a.state, b.state);
  expect_same_bits(a.sensed.time_s, b.sensed.time_s);
  expect_same_bits(a.clock_s, b.clock_s);
  expect_same_bits(a.late_ms, b.late_ms);
  expect_same_bits(a.command.left_mps, b.command.left_mps);
  expect_same_bits(a.command.right_mps, b.command.right_mps);
  EXPECT_EQ(a.command.leds, b.command.leds);
  for (std::size_t i = 0; i < kProximitySensors; ++i) {
    expect_same_bits(a.sensed.proximity_m[i], b.sensed.proximity_m[i]);
    expect_same_bits(a.sensed.light_lux[i], b.sensed.light_lux[i]);
  }
  EXPECT_EQ(a.sensed.ground, b.sensed.ground);
  EXPECT_EQ(a.ground_as_sent, b.ground_as_sent);
  ASSERT_EQ(a.sensed.neighbours.size(), b.sensed.neighbours.size());
  for (std::size_t i = 0; i < a.sensed.neighbours.size(); ++i) {
    expect_same_bits(a.sensed.neighbours[i].distance_m, b.sensed.neighbours[i].distance_m);
    expect_same_bits(a.sensed.neighbours[i].direction_x, b.sensed.neighbours[i].direction_x);
    expect_same_bits(a.sensed.neighbours[i].direction_y, b.sensed.neighbours[i].direction_y);
  }
  EXPECT_EQ(a.age_ms, b.age_ms);
  EXPECT_EQ(a.stamp_ms, b.stamp_ms);
  EXPECT_EQ(a.drawn, b.drawn);
  EXPECT_EQ(a.event, b.event);
}

std::string first_error(const auto& read) {
  return read ? "none" : to_string(read.error().front());
}

TEST(LogText, GivesBackEveryRowBitByBit) {
  Rng rng(3);
  std::vector<LogRow> rows;
  std::string text = log_columns();
  for (int i = 0; i < 500; ++i) {
    rows.push_back(random_row(rng));
    text += log_line(rows.back());
  }
  const auto read = parse_log_rows(text, "a.log.csv");
  ASSERT_TRUE(read) << first_error(read);
  ASSERT_EQ(read->size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    expect_same(rows[i], (*read)[i]);
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
