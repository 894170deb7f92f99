#include "tracking/robots/film_rate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

/// Straight for a while, then a turn on the spot, and so on.
std::vector<TimedCommand> exploring(double seconds, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<TimedCommand> commands;
  int left = 0;
  bool is_straight = false;
  double side = 1;
  for (int cycle = 0; cycle < static_cast<int>(10 * seconds); ++cycle) {
    if (left-- <= 0) {
      is_straight = !is_straight;
      left = static_cast<int>(rng.uniform(4, is_straight ? 30 : 12));
      side = rng.uniform(0, 1) < 0.5 ? -1 : 1;
    }
    commands.push_back(
        {0.1 * cycle, is_straight ? 0.3 : -0.3 * side, is_straight ? 0.3 : 0.3 * side});
  }
  return commands;
}

/// What a camera sees of treads that slip and come late, on a film that plays `speed` times as
/// fast.
std::vector<Sample> filmed(const std::vector<TimedCommand>& commands, double speed, double late_s,
                           double rate_hz = 15) {
  Rng rng(3);
  std::vector<Sample> samples;
  Pose pose;
  constexpr double kStep_s = 0.001;
  const double end_s = commands.back().time_s;
  double next_s = 0;
  for (double time = 0; time < end_s; time += kStep_s) {
    const auto at = static_cast<std::int64_t>(std::floor((time - late_s) / 0.1));
    const TimedCommand told = at < 0 ? TimedCommand{} : commands[static_cast<std::size_t>(at)];
    const SinCos heading = sin_cos(pose.theta);
    const double way = 0.9 * (told.left_mps + told.right_mps) / 2 * kStep_s;
    pose.x += way * heading.cos;
    pose.y += way * heading.sin;
    pose.theta += 0.8 * (told.right_mps - told.left_mps) / 0.147 * kStep_s;
    if (time < next_s) continue;
    next_s += 1 / rate_hz;
    Sample sample{.time_s = time / speed, .pose = pose};
    sample.pose.x += 0.0005 * rng.normal();
    sample.pose.y += 0.0005 * rng.normal();
    sample.pose.theta = wrap_angle(pose.theta + 0.005 * rng.normal());
    samples.push_back(sample);
  }
  return samples;
}

FilmRate rate_of(double speed, double late_s, double seconds) {
  std::vector<std::vector<Sample>> seen;
  std::vector<ToldAndSeen> robots;
  for (std::uint64_t robot = 0; robot < 3; ++robot)
    seen.push_back(filmed(exploring(seconds, robot + 1), speed, late_s));
  for (std::uint64_t robot = 0; robot < 3; ++robot)
    robots.push_back({exploring(seconds, robot + 1), seen[robot]});
  return film_rate(robots);
}

TEST(FilmRateTest, IsWhatTheRobotsClocksSay) {
  for (const double speed : {0.667, 0.733, 0.97, 1.0, 1.02, 1.4, 1.9}) {
    const FilmRate found = rate_of(speed, 0.12, 60);
    ASSERT_TRUE(found.rate) << speed << found.reason;
    EXPECT_NEAR(*found.rate, speed, 0.003 * speed);
    EXPECT_NEAR(found.off_s, std::fabs(1 - 1 / speed) * 60, 0.2) << speed;
  }
}

TEST(FilmRateTest, IsToldSoonerWhereItIsFarOff) {
  for (const double speed : {0.667, 0.733, 1.4, 1.9}) {
    const FilmRate found = rate_of(speed, 0.12, 12);
    ASSERT_TRUE(found.rate) << speed << found.reason;
    EXPECT_NEAR(*found.rate, speed, 0.03 * speed);
  }
}

/// By a clock that was right the run began 12.4 s after the film; the film plays otherwise.
TEST(FilmRateTest, IsToldWhereTheStartIsOffByIt) {
  constexpr double kStart_s = 12.4;
  for (const double speed : {0.667, 0.97, 1.0, 1.4}) {
    const std::vector<TimedCommand> commands = exploring(60, 1);
    std::vector<Sample> seen = filmed(commands, speed, 0.12);
    for (Sample& sample : seen)
      sample.time_s += kStart_s / speed - kStart_s;
    const FilmRate found = film_rate(std::vector<ToldAndSeen>{{commands, seen}}, kStart_s);
    ASSERT_TRUE(found.rate) << speed << found.reason;
    EXPECT_NEAR(*found.rate, speed, 0.003 * speed);
  }
}

TEST(FilmRateTest, IsNotToldWhereNothingTellsIt) {
  EXPECT_FALSE(film_rate({}).rate);
  const std::vector<TimedCommand> straight(600, TimedCommand{0, 0.3, 0.3});
  std::vector<TimedCommand> commands = straight;
  for (std::size_t i = 0; i < commands.size(); ++i)
    commands[i].time_s = 0.1 * static_cast<double>(i);
  const std::vector<Sample> seen = filmed(commands, 1, 0.1);
  EXPECT_FALSE(film_rate(std::vector<ToldAndSeen>{{commands, seen}}).rate);
  // Another robot's log.
  const std::vector<Sample> other = filmed(exploring(60, 5), 1, 0.1);
  EXPECT_FALSE(film_rate(std::vector<ToldAndSeen>{{exploring(60, 6), other}}).rate);
}

}  // namespace
}  // namespace swarmsmith
