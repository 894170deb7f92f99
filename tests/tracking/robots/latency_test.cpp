#include "tracking/robots/latency.h"

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Commands = std::vector<TimedCommand>;

/// Straight for seconds, then a turn on the spot, and so on, in steps of 0.1 s.
Commands exploring(double seconds, std::uint64_t seed, double straight_s = 2, double turn_s = 0.9) {
  Rng rng(seed);
  Commands commands;
  bool is_straight = true;
  double left_s = 0;
  double side = 1;
  for (int cycle = 0; cycle < static_cast<int>(std::lround(seconds * 10)); ++cycle) {
    if (left_s <= 0) {
      is_straight = cycle == 0 || !is_straight;
      left_s = (is_straight ? straight_s : turn_s) * rng.uniform(0.5, 1.5);
      side = rng.uniform(0, 1) < 0.5 ? -1 : 1;
    }
    left_s -= 0.1;
    commands.push_back(
        {cycle * 0.1, is_straight ? 0.3 : -0.3 * side, is_straight ? 0.3 : 0.3 * side});
  }
  return commands;
}

/// How a robot answers to its commands, and how it is seen.
struct World {
  double latency_s = 0;
  double latency_spread_s = 0;  ///< each command's own, uniform and up to this more
  double ramp_s = 0;            ///< from 0 to 0.3 m/s
  double way_gain = 0.97;
  double turn_gain = 0.8;  ///< treads slip
  double frame_rate = 30;
  double from_s = -0.5;
  double noise_m = 0.0005;
  double noise_rad = 0.005;
  double heading_off_rad = 0;
  std::uint64_t seed = 5;
};

std::vector<Sample> seen(const Commands& commands, const World& world) {
  Rng rng(world.seed);
  std::vector<double> acts_s;
  for (const TimedCommand& command : commands) {
    const double late = world.latency_s + world.latency_spread_s * rng.uniform(0, 1);
    acts_s.push_back(std::max(command.time_s + late, acts_s.empty() ? -1 : acts_s.back()));
  }
  constexpr double kStep_s = 0.0002;
  std::vector<Sample> samples;
  Pose pose{0.2, -0.1, 0.7};
  double left = 0;
  double right = 0;
  std::size_t next = 0;
  double frame_s = world.from_s;
  const double end_s = commands.back().time_s + 0.5;
  for (double time_s = world.from_s; time_s < end_s; time_s += kStep_s) {
    if (time_s >= frame_s) {
      Sample sample;
      sample.time_s = time_s;
      sample.frame = static_cast<std::int64_t>(samples.size());
      sample.pose = {pose.x + rng.normal(0, world.noise_m), pose.y + rng.normal(0, world.noise_m),
                     pose.theta + world.heading_off_rad + rng.normal(0, world.noise_rad)};
      samples.push_back(sample);
      frame_s += 1 / world.frame_rate;
    }
    while (next < commands.size() && acts_s[next] <= time_s)
      ++next;
    const TimedCommand wanted = next == 0 ? TimedCommand{} : commands[next - 1];
    const double most = world.ramp_s > 0 ? 0.3 / world.ramp_s * kStep_s : 10;
    left += std::clamp(wanted.left_mps - left, -most, most);
    right += std::clamp(wanted.right_mps - right, -most, most);
    const double way = world.way_gain * (left + right) / 2 * kStep_s;
    pose.x += way * std::cos(pose.theta);
    pose.y += way * std::sin(pose.theta);
    pose.theta += world.turn_gain * (right - left) / 0.147 * kStep_s;
  }
  return samples;
}

TEST(LatencyTest, IsFoundToMillisecondsWithTheNoiseOfACamera) {
  double squares = 0;
  int runs = 0;
  for (const double latency_s : {0.0, 0.06, 0.2, 0.437}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Commands commands = exploring(120, seed);
      const Latency found =
          latency_of(commands, seen(commands, {.latency_s = latency_s, .seed = seed + 100}));
      ASSERT_TRUE(found.seconds) << found.reason;
      EXPECT_NEAR(*found.seconds, latency_s, 0.003) << "seed " << seed;
      EXPECT_LT(found.error_s, 0.003);
      EXPECT_GT(*found.agreement, 0.95);
      squares += std::pow((*found.seconds - latency_s) / found.error_s, 2);
      ++runs;
    }
  }
  // The standard error says how wrong it is.
  EXPECT_LT(std::sqrt(squares / runs), 2.5);
}

TEST(LatencyTest, DependsNeitherOnTheFrameRateNorOnTheHeadingsOffset) {
  const Commands commands = exploring(60, 3);
  for (const double rate : {10.0, 15.0, 60.0}) {
    const Latency found =
        latency_of(commands, seen(commands, {.latency_s = 0.12, .frame_rate = rate}));
    ASSERT_TRUE(found.seconds) << found.reason;
    EXPECT_NEAR(*found.seconds, 0.12, 0.005) << rate;
  }
  // Without a straight drive of the calibration the heading is off by any angle.
  const Latency found =
      latency_of(commands, seen(commands, {.latency_s = 0.12, .heading_off_rad = 2}));
  ASSERT_TRUE(found.seconds) << found.reason;
  EXPECT_NEAR(*found.seconds, 0.12, 0.004);
}

/// Commands that come at once or late look like treads that are slow.
TEST(LatencyTest, ThatVariesIsFoundBetweenItsLeastAndItsMean) {
  const Commands commands = exploring(120, 4);
  const Latency steady = latency_of(commands, seen(commands, {.latency_s = 0.2}));
  const Latency varying =
      latency_of(commands, seen(commands, {.latency_s = 0.1, .latency_spread_s = 0.2}));
  ASSERT_TRUE(varying.seconds) << varying.reason;
  EXPECT_GT(*varying.seconds, 0.08);
  EXPECT_LT(*varying.seconds, 0.22);
  EXPECT_GT(varying.error_s, steady.error_s);
}

TEST(LatencyTest, TheTimeThatTreadsTakeToReachTheirSpeedIsNoPartOfIt) {
  struct Film {
    double ramp_s, rate;
  };
  // A short ramp lies between two frames, or nearly.
  for (const Film& film :
       {Film{0.05, 15}, Film{0.05, 25}, Film{0.05, 30}, Film{0.2, 30}, Film{0.4, 30}}) {
    const Commands commands = exploring(120, 6);
    const Latency found = latency_of(commands, seen(commands, {.latency_s = 0.06,
                                                               .ramp_s = film.ramp_s,
                                                               .turn_gain = 0.7,
                                                               .frame_rate = film.rate}));
    ASSERT_TRUE(found.seconds) << found.reason;
    EXPECT_NEAR(*found.seconds, 0.06, 0.006) << film.ramp_s << " s, " << film.rate << " a second";
  }
}

TEST(LatencyTest, ThreeTurnsDo) {
  const Commands commands = exploring(20, 8, 6, 1);
  const Latency found = latency_of(commands, seen(commands, {.latency_s = 0.2}));
  ASSERT_TRUE(found.seconds) << found.reason;
  EXPECT_NEAR(*found.seconds, 0.2, 0.01);
}

TEST(LatencyTest, TheStartAloneDoesWhenItWasFilmed) {
  Commands commands;
  for (int cycle = 0; cycle < 300; ++cycle)
    commands.push_back({cycle * 0.1, 0.3, 0.3});
  const Latency found = latency_of(commands, seen(commands, {.latency_s = 0.06}));
  ASSERT_TRUE(found.seconds) << found.reason;
  EXPECT_NEAR(*found.seconds, 0.06, 0.01);
  const Latency unseen = latency_of(commands, seen(commands, {.latency_s = 0.06, .from_s = 2}));
  EXPECT_FALSE(unseen.seconds);
  EXPECT_THAT(unseen.reason, HasSubstr("its commands"));
  EXPECT_THAT(unseen.reason, HasSubstr("change"));
}

TEST(LatencyTest, OfARobotThatStandsCannotBeTold) {
  Commands commands;
  for (int cycle = 0; cycle < 300; ++cycle)
    commands.push_back({cycle * 0.1, 0, 0});
  const Latency found = latency_of(commands, seen(commands, {}));
  EXPECT_FALSE(found.seconds);
  EXPECT_FALSE(found.agreement);
  EXPECT_EQ(found.reason, "its commands did not move it");
}

TEST(LatencyTest, CannotBeToldFromAnotherRobotsLogOrOneThatWasHeld) {
  const Latency other = latency_of(exploring(120, 1), seen(exploring(120, 2), {.latency_s = 0.1}));
  EXPECT_FALSE(other.seconds);
  ASSERT_TRUE(other.agreement);
  EXPECT_LT(*other.agreement, kLeastAgreement);
  EXPECT_THAT(other.reason, HasSubstr("does not follow its commands"));
  const Commands commands = exploring(120, 1);
  const Latency held = latency_of(commands, seen(commands, {.way_gain = 0, .turn_gain = 0}));
  EXPECT_FALSE(held.seconds);
  EXPECT_THAT(held.reason, HasSubstr("does not follow its commands"));
}

TEST(LatencyTest, CannotBeToldFromALogThatIsShortOrEmpty) {
  const Commands commands = exploring(120, 1);
  const std::vector<Sample> samples = seen(commands, {});
  EXPECT_EQ(latency_of({}, samples).reason, "its log has no commands");
  const Latency few = latency_of(std::span(commands).first(8), samples);
  EXPECT_FALSE(few.seconds);
  EXPECT_THAT(few.reason, HasSubstr("pairs of frames"));
  EXPECT_FALSE(latency_of(commands, {}).seconds);
}

TEST(LatencyTest, BeyondWhatIsTriedAsksForTheStart) {
  const Commands commands = exploring(120, 1, 12, 3);
  const Latency late = latency_of(commands, seen(commands, {.latency_s = 1.7}));
  EXPECT_FALSE(late.seconds);
  EXPECT_THAT(late.reason, HasSubstr("is the start of the run right?"));
}

TEST(LatencyTest, SamplesThatWereNotUsedDoNotCount) {
  const Commands commands = exploring(60, 3);
  std::vector<Sample> samples = seen(commands, {.latency_s = 0.1});
  const Latency before = latency_of(commands, samples);
  std::vector<Sample> with_strays;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    with_strays.push_back(samples[i]);
    if (i % 7 != 0) continue;
    Sample stray = samples[i];
    stray.use = Sample::Use::Outlier;
    stray.pose.x += 0.5;
    with_strays.push_back(stray);
  }
  EXPECT_EQ(latency_of(commands, with_strays).seconds, before.seconds);
}

TEST(LatencyTest, TwoCamerasThatDisagreeByMillimetresAreNoJumps) {
  const Commands commands = exploring(60, 3);
  std::vector<Sample> samples = seen(commands, {.latency_s = 0.1});
  std::vector<Sample> second = seen(commands, {.latency_s = 0.1, .from_s = -0.49, .seed = 77});
  for (Sample& sample : second) {
    sample.camera = 1;
    sample.pose.x += 0.005;
    samples.push_back(sample);
  }
  std::ranges::sort(samples, {}, &Sample::time_s);
  const Latency found = latency_of(commands, samples);
  ASSERT_TRUE(found.seconds) << found.reason;
  EXPECT_NEAR(*found.seconds, 0.1, 0.003);
}

}  // namespace
}  // namespace swarmsmith
