#include "sim/engine/internal/robot_senses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Three robots in the arena of the thesis: 0 looks at 1 from 0.35 m, 2 is far off.
struct Scene {
  Arena arena = dodecagon_of_the_thesis();
  std::vector<Pose> poses = {{0, 0, 0}, {0.5, 0, 0}, {0, -1, kPi}};
  Profile profile;
  World world{arena, rvr(), poses, ContactModel::Exact};

  RobotSenses senses(int robot, std::uint64_t seed = 1) const {
    return RobotSenses(world, arena, profile, robot, Rng(seed));
  }
};

TEST(RobotSenses, ReadWhatIsThere) {
  const Scene scene;
  RobotSenses senses = scene.senses(0);
  senses.begin_cycle({.number = 1});
  EXPECT_NEAR(senses.proximity()[1], 0.5 - 2 * kHalfSide_m, 1e-12);
  for (std::size_t i = 0; i < kProximitySensors; ++i) {
    EXPECT_TRUE(i == 1 || senses.proximity()[i] == kInfinity) << i;
  }
  EXPECT_EQ(senses.ground_color(), (Rgb{127, 127, 127}));
  ASSERT_EQ(senses.neighbours().size(), 1);
  EXPECT_DOUBLE_EQ(senses.neighbours()[0].distance_m, 0.5);
  EXPECT_DOUBLE_EQ(senses.neighbours()[0].direction_x, 1);
}

TEST(RobotSenses, DoNotSeeNeighboursBehindWhatIsAsHighAsTheCamera) {
  const std::vector<Pose> poses = {{0, 0, 0}, {0.6, 0, 0}, {0, 0.6, 0}};
  Profile profile;
  const auto seen = [&](Arena arena) {
    const World world(arena, rvr(), poses, ContactModel::Exact);
    RobotSenses senses(world, arena, profile, 0, Rng(1));
    senses.begin_cycle({.number = 1});
    return senses.neighbours().size();
  };
  for (const auto source : {NeighbourSensing::Source::Camera, NeighbourSensing::Source::Lidar}) {
    profile.neighbours.source = source;
    Arena arena = dodecagon_of_the_thesis();
    EXPECT_EQ(seen(arena), 2);
    arena.obstacles = {{.outline = BoxOutline{0.02, 0.3}, .pose = {0.3, 0, 0}, .height_m = 0.16}};
    EXPECT_EQ(seen(arena), 1);
    arena.obstacles[0].height_m = 0.15;
    EXPECT_EQ(seen(arena), 2);
    arena.objects = {{.outline = CircleOutline{0.05}, .start = {0, 0.3, 0}, .height_m = 0.154}};
    EXPECT_EQ(seen(arena), 1);
  }
}

TEST(RobotSenses, RaysPassOverWhatIsLow) {
  const std::vector<Pose> poses = {{0, 0, 0}};
  Arena arena = dodecagon_of_the_thesis();
  arena.obstacles = {{.outline = BoxOutline{0.2, 0.4}, .pose = {0.5, 0, 0}, .height_m = 0.3}};
  arena.objects = {{.outline = CircleOutline{0.1}, .start = {-0.5, 0, 0}, .height_m = 0.3}};
  const Profile profile;
  const auto look = [&](double height_m) {
    arena.obstacles[0].height_m = height_m;
    arena.objects[0].height_m = height_m;
    const World world(arena, rvr(), poses, ContactModel::Exact);
    RobotSenses senses(world, arena, profile, 0, Rng(1));
    senses.begin_cycle({.number = 1});
    return senses.read(Sensor::Proximity | Sensor::Lidar);
  };
  const Readings high = look(0.3);
  EXPECT_NEAR(high.proximity_m[1], 0.4 - 0.143, 1e-12);
  EXPECT_NEAR(high.proximity_m[5], 0.4 - 0.143, 1e-12);
  EXPECT_NEAR(high.lidar_m[0], 0.4, 1e-9);
  // Between the two: proximity rays run at 32 mm, the lidar's at 40 mm.
  const Readings middle = look(0.036);
  EXPECT_NEAR(middle.proximity_m[1], 0.4 - 0.143, 1e-12);
  EXPECT_NEAR(middle.lidar_m[0], 1.226, 1e-9);
  const Readings low = look(0.03);
  EXPECT_EQ(low.proximity_m[1], kInfinity);
  EXPECT_EQ(low.proximity_m[5], kInfinity);
}

TEST(RobotSenses, TheDirectionOfANeighbourIsInTheRobotsFrame) {
  const Scene scene;
  RobotSenses senses = scene.senses(1);
  senses.begin_cycle({.number = 1});
  ASSERT_EQ(senses.neighbours().size(), 1);
  EXPECT_DOUBLE_EQ(senses.neighbours()[0].direction_x, -1);
  EXPECT_NEAR(senses.neighbours()[0].direction_y, 0, 1e-15);
}

TEST(RobotSenses, TheGroundSensorLooksAhead) {
  Scene scene;
  scene.arena.patches.push_back({Disc{{0.5, 0}, 0.46}, {0, 0, 0}});
  RobotSenses senses = scene.senses(0);
  senses.begin_cycle({.number = 1});
  EXPECT_EQ(senses.ground_color(), (Rgb{0, 0, 0}));
}

TEST(RobotSenses, AReadingIsTheSameAllCycleAndAnotherInTheNext) {
  Scene scene;
  scene.profile.proximity.sd_m = 0.01;
  RobotSenses senses = scene.senses(0);
  senses.begin_cycle({.number = 1});
  const double first = senses.proximity()[1];
  EXPECT_EQ(senses.proximity()[1], first);
  senses.begin_cycle({.number = 2});
  EXPECT_NE(senses.proximity()[1], first);
}

TEST(RobotSenses, NoiseDoesNotDependOnWhatElseWasAsked) {
  Scene scene;
  scene.profile.proximity.sd_m = 0.01;
  scene.profile.ground_color.sd = 5;
  RobotSenses all = scene.senses(0);
  RobotSenses few = scene.senses(0);
  for (int cycle = 1; cycle <= 50; ++cycle) {
    all.begin_cycle({.number = cycle});
    few.begin_cycle({.number = cycle});
    const Rgb color = all.ground_color();
    const double distance = all.proximity()[1];
    if (cycle % 7 == 0) {
      EXPECT_EQ(few.ground_color(), color);
    }
    if (cycle % 11 == 0) {
      EXPECT_EQ(few.proximity()[1], distance);
    }
  }
}

TEST(RobotSenses, TheFrontAloneReadsAsItDoesAmongAll) {
  Scene scene;
  scene.profile.proximity = {
      .sd_m = 0.01, .scale_sd = 0.1, .largest_miss_rate = 0.2, .phantom_rate = 0.05};
  for (const bool only_normal : {false, true}) {
    if (only_normal) scene.profile.proximity = {.sd_m = 0.01};
    RobotSenses all = scene.senses(0);
    RobotSenses front = scene.senses(0);
    for (int cycle = 1; cycle <= 200; ++cycle) {
      all.begin_cycle({.number = cycle});
      front.begin_cycle({.number = cycle});
      const FrontProximity seen = front.front_proximity();
      for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_EQ(seen[i], all.proximity()[i]);
      EXPECT_FALSE(front.computed().has(Sensor::Proximity));
      EXPECT_TRUE(std::ranges::equal(front.proximity(), all.proximity()));
      EXPECT_EQ(front.front_proximity().data(), front.proximity().data());
    }
  }
}

TEST(RobotSenses, NoiseDependsOnSeedAndRobot) {
  Scene scene;
  scene.profile.ground_color.sd = 50;
  std::vector<Rgb> colors;
  for (const int robot : {0, 1}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      RobotSenses senses = scene.senses(robot, seed);
      senses.begin_cycle({.number = 1});
      for (const Rgb& other : colors)
        EXPECT_NE(senses.ground_color(), other);
      colors.push_back(senses.ground_color());
    }
  }
  EXPECT_EQ(colors.size(), 4U);
}

TEST(RobotSenses, ProximityNoiseHasItsMoments) {
  Scene scene;
  scene.profile.proximity.sd_m = 0.01;
  RobotSenses senses = scene.senses(0);
  const double truth = 0.5 - 2 * kHalfSide_m;
  constexpr int kCycles = 20'000;
  double sum = 0;
  double squares = 0;
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    senses.begin_cycle({.number = cycle});
    const double error = senses.proximity()[1] - truth;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kCycles, 0, 4 * 0.01 / std::sqrt(kCycles));
  EXPECT_NEAR(std::sqrt(squares / kCycles), 0.01, 0.0003);
}

TEST(RobotSenses, LimitsHoldAfterTheNoise) {
  Scene scene;
  scene.profile.proximity.sd_m = 0.2;
  RobotSenses senses = scene.senses(0);
  int near = 0;
  int far = 0;
  for (int cycle = 1; cycle <= 1000; ++cycle) {
    senses.begin_cycle({.number = cycle});
    const double reading = senses.proximity()[1];
    near += reading == -kInfinity ? 1 : 0;
    far += reading == kInfinity ? 1 : 0;
    EXPECT_TRUE(std::isinf(reading) || (reading >= 0.05 && reading <= 0.4)) << reading;
    EXPECT_EQ(senses.proximity()[5], kInfinity) << "no noise where nothing is";
  }
  EXPECT_NEAR(near / 1000.0, normal_cdf((0.05 - 0.214) / 0.2), 0.05);
  EXPECT_NEAR(far / 1000.0, 1 - normal_cdf((0.4 - 0.214) / 0.2), 0.05);
}

TEST(RobotSenses, GroundNoiseHasItsMomentsOnEachChannelOfItsOwn) {
  Scene scene;
  scene.profile.ground_color.sd = 5;
  RobotSenses senses = scene.senses(0);
  constexpr int kCycles = 20'000;
  double sum_r = 0;
  double squares_g = 0;
  double product = 0;
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    senses.begin_cycle({.number = cycle});
    const Rgb color = senses.ground_color();
    sum_r += color.r - 127;
    squares_g += (color.g - 127) * (color.g - 127);
    product += (color.r - 127) * (color.b - 127);
  }
  EXPECT_NEAR(sum_r / kCycles, 0, 4 * 5 / std::sqrt(kCycles));
  // Rounding adds a twelfth to the variance.
  EXPECT_NEAR(squares_g / kCycles, 25 + 1.0 / 12, 1);
  EXPECT_NEAR(product / kCycles / 25, 0, 0.03);
}

TEST(RobotSenses, GroundNoiseIsClampedToAByte) {
  Scene scene;
  scene.profile.ground_color.sd = 5;
  scene.arena.floor = {0, 255, 0};
  RobotSenses senses = scene.senses(0);
  int black = 0;
  for (int cycle = 1; cycle <= 1000; ++cycle) {
    senses.begin_cycle({.number = cycle});
    const Rgb color = senses.ground_color();
    EXPECT_LT(color.r, 40);
    EXPECT_GT(color.g, 215);
    black += color.r == 0 ? 1 : 0;
  }
  EXPECT_NEAR(black / 1000.0, normal_cdf(0.5 / 5), 0.06);
}

double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

TEST(RobotSenses, AWireOfFloat32RoundsDistancesAndNeighboursAndLeavesTheRest) {
  Scene scene{.poses = {{0.01, 0.02, 0.3}, {0.4, 0.11, 1}, {0, -1, kPi}}};
  scene.profile.proximity.sd_m = 0.01;
  scene.profile.ground_color.sd = 5;
  Profile wired = scene.profile;
  wired.float32_wire = true;
  for (const auto source : {NeighbourSensing::Source::Camera, NeighbourSensing::Source::Lidar}) {
    scene.profile.neighbours.source = source;
    wired.neighbours.source = source;
    RobotSenses exact = scene.senses(0);
    RobotSenses sent(scene.world, scene.arena, wired, 0, Rng(1));
    RobotSenses asked_for_the_front(scene.world, scene.arena, wired, 0, Rng(1));
    for (RobotSenses* senses : {&exact, &sent, &asked_for_the_front})
      senses->begin_cycle({.number = 1});
    bool any = false;
    for (std::size_t i = 0; i < kProximitySensors; ++i) {
      EXPECT_EQ(sent.proximity()[i], as_float(exact.proximity()[i])) << i;
      any |= std::isfinite(exact.proximity()[i]);
      if (i < kFrontSensors) {
        EXPECT_EQ(asked_for_the_front.front_proximity()[i], sent.proximity()[i]) << i;
      }
    }
    EXPECT_TRUE(any);
    EXPECT_EQ(sent.ground_color(), exact.ground_color());
    ASSERT_EQ(sent.neighbours().size(), 1);
    const Neighbour seen = sent.neighbours()[0];
    const Neighbour there = exact.neighbours()[0];
    if (source == NeighbourSensing::Source::Camera) {
      EXPECT_EQ(seen.distance_m, as_float(there.distance_m));
      EXPECT_EQ(seen.direction_x, as_float(there.direction_x));
      EXPECT_EQ(seen.direction_y, as_float(there.direction_y));
    } else {
      // The scan is rounded, not what is made of it.
      EXPECT_NE(seen.distance_m, there.distance_m);
      EXPECT_NEAR(seen.distance_m, there.distance_m, 1e-7);
      EXPECT_NE(seen.distance_m, as_float(seen.distance_m));
    }
    const std::vector<double> scan = exact.read(Sensor::Lidar).lidar_m;
    for (std::size_t ray = 0; ray < scan.size(); ++ray)
      EXPECT_EQ(sent.read(Sensor::Lidar).lidar_m[ray], as_float(scan[ray]));
  }
}

TEST(RobotSenses, WhatTouchesMayReadAsNothing) {
  Scene scene{.poses = {{0, 0, 0}, {0.3, 0, 0}, {0, -0.5, kPi}}};
  RobotSenses senses = scene.senses(0);
  senses.begin_cycle({.number = 1});
  EXPECT_EQ(senses.proximity()[1], -kInfinity);
  const double right = senses.proximity()[3];
  EXPECT_TRUE(std::isfinite(right));
  scene.profile.proximity.touch_is_nothing = true;
  RobotSenses blind = scene.senses(0);
  blind.begin_cycle({.number = 1});
  EXPECT_EQ(blind.front_proximity()[1], kInfinity);
  EXPECT_EQ(blind.proximity()[1], kInfinity);
  EXPECT_EQ(blind.proximity()[3], right);
}

/// Cycles from `cycle` up to that at a sub-step, one a sub-step, in which the reading stays as it
/// is.
template <class Read>
void expect_held_until(RobotSenses& senses, std::int64_t& now, std::int64_t beat,
                       const Read& read) {
  const auto held = read();
  while (++now < beat) {
    senses.begin_cycle({.number = now});
    EXPECT_EQ(read(), held) << now;
  }
}

TEST(RobotSenses, AReadingOfADriverHoldsFromBeatToBeat) {
  Scene scene;
  scene.profile.ground_color.sd = 40;  // so that two readings are never the same
  scene.profile.lidar.half_width_m = 0.01;
  scene.profile.neighbours.source = NeighbourSensing::Source::Lidar;
  scene.profile.proximity.sd_m = 0.01;
  const auto ground = [](RobotSenses& senses) { return senses.ground_color(); };
  const auto neighbour = [](RobotSenses& senses) { return senses.neighbours()[0].distance_m; };
  const auto holds = [&](const auto& read_with, int every) {
    RobotSenses senses = scene.senses(0);
    const auto read = [&] { return read_with(senses); };
    std::int64_t now = 0;
    std::int64_t beat = senses.next_beat();
    EXPECT_GE(beat, 1);
    EXPECT_LE(beat, every);
    for (int reading = 0; reading < 3; ++reading) {
      const auto before = read();
      expect_held_until(senses, now, beat, read);
      senses.read_at_beat(now);
      EXPECT_EQ(senses.next_beat(), beat + every);
      beat = senses.next_beat();
      senses.begin_cycle({.number = now});
      EXPECT_NE(read(), before);
    }
    const double distance = senses.proximity()[1];
    senses.begin_cycle({.number = now + 1});
    EXPECT_NE(senses.proximity()[1], distance) << "of another device, read in each cycle";
  };
  scene.profile.timing.driver_sub_steps = 20;
  holds(ground, 20);
  scene.profile.timing.driver_sub_steps = 0;
  scene.profile.neighbours.every_sub_steps = 10;
  holds(neighbour, 10);
  scene.profile.neighbours.every_sub_steps = 0;
  EXPECT_EQ(scene.senses(0).next_beat(), Beats::kNever);
}

TEST(RobotSenses, BeatsHaveAnotherPhaseForEachRobotAndRun) {
  Scene scene;
  scene.profile.timing.driver_sub_steps = 20;
  std::set<std::int64_t> firsts;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const int robot : {0, 1, 2})
      firsts.insert(scene.senses(robot, seed).next_beat());
  }
  EXPECT_GT(firsts.size(), 10);
}

}  // namespace
}  // namespace swarmsmith
