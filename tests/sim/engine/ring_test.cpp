#include "sim/engine/internal/ring.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include "base/math.h"
#include "sim/control/behaviours/exploration.h"
#include "sim/control/readings.h"
#include "sim/engine/fitting.h"
#include "sim/engine/internal/robot_senses.h"

// Robots with more sensors than the RVR.

namespace swarmsmith {
namespace {

constexpr std::size_t kSensors = 24;
constexpr std::size_t kSeeing = 21;  ///< the sensor at -37.5 degrees

double angle_of(std::size_t sensor) {
  return (7.5 + 15 * static_cast<double>(sensor)) * kPi / 180;
}

/// A disc of 0.085 m with 24 proximity and 24 light sensors, such as the foot-bot of ARGoS.
Robot foot_bot() {
  Robot robot;
  robot.name = "foot-bot";
  robot.body.outline = CircleOutline{0.085};
  robot.proximity.rays_deg.clear();
  for (std::size_t i = 0; i < kSensors; ++i)
    robot.proximity.rays_deg.push_back(angle_of(i) * 180 / kPi);
  robot.light.out_m = 0.085;
  return robot;
}

/// One whose proximity sensors reach 0.1 m and give strengths.
Robot foot_bot_of_strengths() {
  Robot robot = foot_bot();
  robot.proximity.reading = ProximityRing::Reading::Strength;
  robot.proximity.reach_m = 0.1;
  robot.proximity.law = {1, -10, 0};
  robot.light.reading = LightRing::Reading::Strength;
  return robot;
}

/// A robot in an arena of 4 x 4 m. The wall x = 2 is `gap_m` from its body, straight ahead of the
/// sensor kSeeing.
struct Room {
  explicit Room(Robot of, double gap_m = 1.915)
      : robot(std::move(of)), pose{2 - 0.085 - gap_m, 0, -angle_of(kSeeing)} {
    const std::array<Point, 4> corners = {{{2, -2}, {2, 2}, {-2, 2}, {-2, -2}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      arena.walls.push_back({corners.at(i), corners.at((i + 1) % corners.size())});
  }

  World world() const { return World(arena, robot, {&pose, 1}, ContactModel::Exact); }

  Arena arena;
  Robot robot;
  Pose pose;
  Profile profile;
};

/// The distance of the wall of the room along the ray.
double distance_along(std::size_t sensor, double gap_m) {
  const double cosine = std::cos(angle_of(sensor) - angle_of(kSeeing));
  return cosine > 1e-9 ? (0.085 + gap_m) / cosine - 0.085 : HUGE_VAL;
}

void expect_towards_the_wall(const Vector2& sum) {
  EXPECT_NEAR(atan2(sum.y, sum.x), wrap_angle(angle_of(kSeeing)), 1e-9);
}

TEST(RingOf24, SeesAWallWithTheSensorsThatPointAtIt) {
  constexpr double kGap_m = 0.06;
  Room room(foot_bot(), kGap_m);
  room.profile.proximity.range_m = 0.1;
  const World world = room.world();
  RobotSenses senses(world, room.arena, room.profile, 0, Rng(1));
  senses.begin_cycle({.number = 1});
  ASSERT_EQ(senses.proximity().size(), kSensors);
  for (std::size_t i = 0; i < kSensors; ++i) {
    const double distance = distance_along(i, kGap_m);
    if (distance > 0.1) {
      EXPECT_EQ(senses.proximity()[i], HUGE_VAL) << i;
    } else {
      EXPECT_NEAR(senses.proximity()[i], distance, 1e-9) << i;
    }
  }
  EXPECT_TRUE(std::isfinite(senses.proximity()[23]));
  EXPECT_EQ(senses.read(Sensor::Proximity).proximity_m.size(), kSensors);

  const Flavour flavour = fitted(**find_flavour("chocolate"), room.robot);
  expect_towards_the_wall(obstacle_sum(senses.proximity(), {}, flavour.obstacles));
  EXPECT_EQ(turn_away(senses, flavour), TurnAway::Left) << "only sensors after the eighth see it";
}

TEST(RingOf24, GivesStrengthsThatAddUpToTheObstacle) {
  constexpr double kGap_m = 0.02;
  const Room room(foot_bot_of_strengths(), kGap_m);
  const World world = room.world();
  RobotSenses senses(world, room.arena, room.profile, 0, Rng(1));
  senses.begin_cycle({.number = 1});
  Vector2 wanted;
  for (std::size_t i = 0; i < kSensors; ++i) {
    const double strength = std::fmax(0, 1 - 10 * distance_along(i, kGap_m));
    EXPECT_NEAR(senses.proximity()[i], strength, 1e-9) << i;
    wanted.x += strength * std::cos(angle_of(i));
    wanted.y += strength * std::sin(angle_of(i));
  }
  for (const char* name : {"chocolate-epuck", "chocolate-epuck-2018"}) {
    const Flavour flavour = fitted(**find_flavour(name), room.robot);
    const Vector2 sum = obstacle_sum(senses.proximity(), {}, flavour.obstacles);
    EXPECT_NEAR(sum.x, wanted.x, 1e-9);
    EXPECT_NEAR(sum.y, wanted.y, 1e-9);
    expect_towards_the_wall(sum);
    EXPECT_EQ(turn_away(senses, flavour), TurnAway::Left);
  }
}

TEST(RingOf24, SeesWhereALightIs) {
  for (const bool strengths : {false, true}) {
    Room room(strengths ? foot_bot_of_strengths() : foot_bot());
    room.arena.lights = {{.x_m = 1, .y_m = 0, .z_m = 0.5, .intensity_cd = 2}};
    const World world = room.world();
    RobotSenses senses(world, room.arena, room.profile, 0, Rng(1));
    senses.begin_cycle({.number = 1});
    ASSERT_EQ(senses.light().size(), kSensors);
    for (std::size_t i = 0; i < kSensors; ++i)
      EXPECT_TRUE(i == kSeeing || senses.light()[i] < senses.light()[kSeeing]) << i;
    EXPECT_EQ(senses.read(Sensor::LightRing).light_lux.size(), kSensors);
    const char* name = strengths ? "chocolate-epuck" : "chocolate";
    expect_towards_the_wall(
        light_vector(senses.light(), fitted(**find_flavour(name), room.robot).light));
  }
}

/// Each reading of two cycles.
template <class Read>
std::set<double> readings_of_two_cycles(RobotSenses& senses, const Read& read) {
  std::set<double> readings;
  for (const int cycle : {1, 2}) {
    senses.begin_cycle({.number = cycle});
    const std::span<const double> ring = read(senses);
    readings.insert(ring.begin(), ring.end());
  }
  return readings;
}

TEST(RingOf24, HasNoiseOfItsOwnInEachSensorAndCycle) {
  Room room(foot_bot_of_strengths());
  // Without noise, each sensor reads 0.5: the law gives that, and four lights all around do.
  room.robot.proximity.law = {0.5, 0, 0};
  room.robot.proximity.reach_m = 5;
  room.robot.light.height_m = 0.1;
  const double intensity = 1 / (std::log(2.0) / 2);
  for (const Point& at : {Point{1, 0}, Point{0, 1}, Point{-1, 0}, Point{0, -1}})
    room.arena.lights.push_back({.x_m = at.x, .y_m = at.y, .z_m = 0.1, .intensity_cd = intensity});
  const auto proximity = [](RobotSenses& senses) { return senses.proximity(); };
  const auto light = [](RobotSenses& senses) { return senses.light(); };
  const World world = room.world();
  for (const double half_width : {0.0, 0.05}) {
    room.profile.proximity.half_width = half_width;
    room.profile.light.half_width = half_width;
    RobotSenses senses(world, room.arena, room.profile, 0, Rng(1));
    for (const auto& readings :
         {readings_of_two_cycles(senses, proximity), readings_of_two_cycles(senses, light)}) {
      for (const double reading : readings)
        EXPECT_NEAR(reading, 0.5, half_width + 1e-9);
      if (half_width > 0) EXPECT_EQ(readings.size(), 2 * kSensors);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
