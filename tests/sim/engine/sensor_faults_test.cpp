#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "sim/engine/internal/robot_senses.h"
#include "tests/sim/engine/statistics.h"

namespace swarmsmith {
namespace {

/// Ground colour and neighbours as profiles spoil them: robot 0 at the origin, robots 1 and 2 at
/// 0.5 m ahead of it and 0.6 m to its left.
struct Scene {
  Arena arena = dodecagon_of_the_thesis();
  std::vector<Pose> poses = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.6, 0}};
  Profile profile;
  World world{arena, rvr(), poses, ContactModel::Exact};

  RobotSenses senses(std::uint64_t seed = 1, int robot = 0) const {
    return RobotSenses(world, arena, profile, robot, Rng(seed));
  }
};

TEST(GroundColor, NoiseIsRoundedNormalNoise) {
  Scene scene;
  scene.profile.ground_color.sd = 5;
  RobotSenses senses = scene.senses();
  constexpr int kCycles = 10'000;
  // By chi-square over the values 112 to 142; those beyond count with the ends.
  std::array<int, 31> counts{};
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    senses.begin_cycle({.number = cycle});
    const Rgb color = senses.ground_color();
    for (const int value : {color.r, color.g, color.b})
      ++counts.at(static_cast<std::size_t>(std::clamp(value - 112, 0, 30)));
  }
  double chi2 = 0;
  for (int i = 0; i <= 30; ++i) {
    const double below = i == 0 ? 0 : normal_cdf((i - 15.5) / 5);
    const double upto = i == 30 ? 1 : normal_cdf((i - 14.5) / 5);
    const double expected = 3 * kCycles * (upto - below);
    const double off = counts.at(static_cast<std::size_t>(i)) - expected;
    chi2 += off * off / expected;
  }
  EXPECT_LT(chi2, 59.7) << "the 99.9 % quantile with 30 degrees of freedom";
}

TEST(GroundColor, ABiasIsNormalAndTheSameOnAllChannelsForTheRun) {
  Scene scene;
  scene.profile.ground_color.bias_sd = 10;
  std::array<int, 9> counts{};  // bins of 5 around 127, ends open
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    RobotSenses senses = scene.senses(seed);
    senses.begin_cycle({.number = 1});
    const Rgb color = senses.ground_color();
    ASSERT_EQ(color.g, color.r);
    ASSERT_EQ(color.b, color.r);
    senses.begin_cycle({.number = 2});
    ASSERT_EQ(senses.ground_color(), color);
    const double place = std::floor((color.r - 127 + 22.5) / 5);
    ++counts.at(static_cast<std::size_t>(std::clamp(place, 0.0, 8.0)));
  }
  double chi2 = 0;
  for (int i = 0; i <= 8; ++i) {
    const double below = i == 0 ? 0 : normal_cdf((5 * i - 22.5) / 10);
    const double upto = i == 8 ? 1 : normal_cdf((5 * i - 17.5) / 10);
    const double expected = 3000 * (upto - below);
    const double off = counts.at(static_cast<std::size_t>(i)) - expected;
    chi2 += off * off / expected;
  }
  EXPECT_LT(chi2, 26.1) << "the 99.9 % quantile with 8 degrees of freedom";
}

TEST(GroundColor, ABiasIsAnotherForEachRobot) {
  Scene scene;
  scene.profile.ground_color.bias_sd = 10;
  RobotSenses first = scene.senses(1, 0);
  RobotSenses second = scene.senses(1, 1);
  first.begin_cycle({.number = 1});
  second.begin_cycle({.number = 1});
  EXPECT_NE(first.ground_color(), second.ground_color());
}

TEST(GroundColor, TheLabelerComesAfterTheNoise) {
  Scene scene;
  scene.profile.ground_color = {.sd = 5, .labeler = true};
  RobotSenses senses = scene.senses();
  for (int cycle = 1; cycle <= 1000; ++cycle) {
    senses.begin_cycle({.number = cycle});
    ASSERT_EQ(senses.ground_color(), (Rgb{127, 127, 127})) << "the only label that is near";
  }
  // Two labels that share the noise's middle: each gets half. On the whole 7 r is 889, and the
  // reading is nearer to the second where r + g + b exceeds 3 * 127.5.
  scene.profile.ground_color.labels = {{120, 120, 120}, {135, 135, 135}};
  RobotSenses between = scene.senses();
  int second = 0;
  for (int cycle = 1; cycle <= 4000; ++cycle) {
    between.begin_cycle({.number = cycle});
    second += between.ground_color() == scene.profile.ground_color.labels[1] ? 1 : 0;
  }
  // The sum of three rounded N(0, 5) must be 2 or more, 1.5 before rounding to whole numbers.
  const double sd = std::sqrt(3 * (25 + 1.0 / 12));
  EXPECT_LT(std::fabs(binomial_z(second, 4000, 1 - normal_cdf(1.5 / sd))), 3.3);
}

TEST(Neighbours, AreMissedAtTheirRate) {
  Scene scene;
  scene.profile.neighbours.miss_rate = 0.05;
  RobotSenses senses = scene.senses();
  std::array<int, 3> counts{};
  for (int cycle = 1; cycle <= 20'000; ++cycle) {
    senses.begin_cycle({.number = cycle});
    ++counts.at(senses.neighbours().size());
  }
  EXPECT_LT(std::fabs(binomial_z(counts[2], 20'000, 0.95 * 0.95)), 3.3);
  EXPECT_LT(std::fabs(binomial_z(counts[0], 20'000, 0.05 * 0.05)), 3.3) << "one by one";
}

TEST(Neighbours, AShareOfTheRobotsHasTroubleForTheWholeRun) {
  Scene scene;
  scene.profile.neighbours = {.miss_rate = 0.05, .weak_share = 0.2, .weak_miss_rate = 0.5};
  int weak = 0;
  int weak_misses = 0;
  int other_misses = 0;
  constexpr int kRuns = 2000;
  constexpr int kCycles = 50;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    RobotSenses senses = scene.senses(seed);
    int misses = 0;
    for (int cycle = 1; cycle <= kCycles; ++cycle) {
      senses.begin_cycle({.number = cycle});
      misses += 2 - static_cast<int>(senses.neighbours().size());
    }
    // 100 chances: about 50 misses or about 5.
    const bool is_weak = misses > 25;
    weak += is_weak ? 1 : 0;
    (is_weak ? weak_misses : other_misses) += misses;
  }
  EXPECT_LT(std::fabs(binomial_z(weak, kRuns, 0.2)), 3.3);
  EXPECT_LT(std::fabs(binomial_z(weak_misses, 100.0 * weak, 0.5)), 3.3);
  EXPECT_LT(std::fabs(binomial_z(other_misses, 100.0 * (kRuns - weak), 0.05)), 3.3);
}

TEST(Neighbours, OfTheLidarAreWhereTheTurretsAre) {
  Scene scene;
  scene.profile.neighbours.source = NeighbourSensing::Source::Lidar;
  RobotSenses senses = scene.senses();
  senses.begin_cycle({.number = 1});
  ASSERT_EQ(senses.neighbours().size(), 2);
  const Neighbour ahead = senses.neighbours()[0];
  // The near side of a cylinder of radius 0.035 m, from its nearest line to its edges.
  EXPECT_GT(ahead.distance_m, 0.465);
  EXPECT_LT(ahead.distance_m, 0.48);
  EXPECT_NEAR(ahead.direction_x, 1, 1e-4);
  EXPECT_NEAR(ahead.direction_y, 0, 0.01);
  EXPECT_NEAR(senses.neighbours()[1].direction_y, 1, 1e-4);
  EXPECT_NEAR(senses.neighbours()[1].distance_m, 0.6 - 0.028, 0.007);
}

TEST(Neighbours, OfTheLidarHaveItsNoiseAndMayBeMissed) {
  Scene scene;
  scene.profile.neighbours.source = NeighbourSensing::Source::Lidar;
  scene.profile.lidar.half_width_m = 0.002;
  RobotSenses senses = scene.senses();
  senses.begin_cycle({.number = 1});
  const double first = senses.neighbours()[0].distance_m;
  senses.begin_cycle({.number = 2});
  EXPECT_NE(senses.neighbours()[0].distance_m, first);
  scene.profile.neighbours.miss_rate = 1;
  RobotSenses blind = scene.senses();
  blind.begin_cycle({.number = 1});
  EXPECT_TRUE(blind.neighbours().empty());
}

}  // namespace
}  // namespace swarmsmith
