#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "sim/control/machine_control.h"
#include "sim/control/machine_text.h"
#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// Arena, light and profile in which every reading has noise or a source.
struct RichScene {
  Arena arena = dodecagon_of_the_thesis();
  std::vector<Pose> poses = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.6, 0}};
  Profile profile = built_in_profile("pseudo-reality").value();
  World world{arena, rvr(), poses, ContactModel::Exact};

  RichScene() {
    profile.neighbours.source = NeighbourSensing::Source::Lidar;
    arena.lights = {{.x_m = 0.5, .y_m = 0.5, .z_m = 1}};
  }

  RobotSenses senses() const { return RobotSenses(world, arena, profile, 0, Rng(1)); }
};

constexpr std::array<Sensor, 12> kAllSensors = {
    Sensor::GroundColor, Sensor::Velocity,   Sensor::Accelerometer, Sensor::Gyroscope,
    Sensor::Imu,         Sensor::FrontLight, Sensor::LightRing,     Sensor::Locator,
    Sensor::Quaternion,  Sensor::Proximity,  Sensor::Lidar,         Sensor::Neighbours};

TEST(Sensors, AnAbsentSensorIsNotComputed) {
  const RichScene scene;
  RobotSenses senses = scene.senses();
  senses.begin_cycle({.number = 1});
  EXPECT_TRUE(senses.computed().empty());
  for (const Sensor sensor : kAllSensors) {
    senses.begin_cycle({.number = 1});
    senses.read(sensor);
    EXPECT_EQ(senses.computed(), Sensors(sensor));
  }
  senses.begin_cycle({.number = 2});
  EXPECT_TRUE(senses.computed().empty());
  const Readings& readings = senses.read(Sensors{});
  EXPECT_TRUE(senses.computed().empty());
  EXPECT_EQ(&readings, &senses.read(Sensors::all()));
  EXPECT_EQ(senses.computed(), Sensors::all());
}

/// What a machine's second cycle computes, the first in which it tests conditions.
Sensors asked_by(const char* machine_text) {
  const RichScene scene;
  const Flavour& flavour = watermelon_argos3();
  const Machine machine = parse_machine(machine_text, flavour).value();
  MachineControl control(machine, flavour, Rng(1));
  RobotSenses senses = scene.senses();
  for (int cycle = 1; cycle <= 2; ++cycle) {
    senses.begin_cycle({.number = cycle});
    control.step(senses);
  }
  return senses.computed();
}

TEST(Sensors, AMachineComputesWhatItsModulesRead) {
  EXPECT_EQ(asked_by("--nstates 1 --s0 1"), Sensors{}) << "Stop";
  EXPECT_EQ(asked_by("--nstates 1 --s0 2 --att0 3"), Sensor::Proximity | Sensor::Neighbours)
      << "Attraction";
  EXPECT_EQ(asked_by("--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 0 --p0x0 1 --s1 1"),
            Sensors(Sensor::GroundColor))
      << "Stop until the floor is black";
  EXPECT_EQ(asked_by("--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 5 --s1 1"),
            Sensors(Sensor::Neighbours))
      << "Stop until neighbours are there";
}

bool same_reading(const Readings& a, const Readings& b, Sensor sensor) {
  switch (sensor) {
    case Sensor::GroundColor:
      return a.ground_color == b.ground_color;
    case Sensor::Velocity:
      return a.velocity_mps == b.velocity_mps;
    case Sensor::Accelerometer:
      return a.acceleration_g == b.acceleration_g;
    case Sensor::Gyroscope:
      return a.spin_radps == b.spin_radps;
    case Sensor::Imu:
      return a.orientation == b.orientation;
    case Sensor::FrontLight:
      return a.front_light_lux == b.front_light_lux;
    case Sensor::LightRing:
      return a.light_lux == b.light_lux;
    case Sensor::Locator:
      return a.position_m == b.position_m;
    case Sensor::Quaternion:
      return a.rotation == b.rotation;
    case Sensor::Proximity:
      return a.proximity_m == b.proximity_m;
    case Sensor::Lidar:
      return a.lidar_m == b.lidar_m;
    case Sensor::Neighbours:
      break;
  }
  if (a.neighbours.size() != b.neighbours.size()) return false;
  for (std::size_t i = 0; i < a.neighbours.size(); ++i) {
    if (a.neighbours[i].distance_m != b.neighbours[i].distance_m) return false;
    if (a.neighbours[i].direction_x != b.neighbours[i].direction_x) return false;
  }
  return true;
}

TEST(Sensors, AReadingDoesNotDependOnTheOthers) {
  const RichScene scene;
  for (const Sensor sensor : kAllSensors) {
    RobotSenses all = scene.senses();
    RobotSenses one = scene.senses();
    for (int cycle = 1; cycle <= 30; ++cycle) {
      all.begin_cycle({.number = cycle, .acted = {0.01 * cycle, 0.1}});
      one.begin_cycle({.number = cycle, .acted = {0.01 * cycle, 0.1}});
      EXPECT_TRUE(same_reading(all.read(Sensors::all()), one.read(sensor), sensor))
          << static_cast<unsigned>(sensor);
    }
  }
}

TEST(Sensors, ReadTwiceInACycleGiveTheSame) {
  const RichScene scene;
  RobotSenses senses = scene.senses();
  for (int cycle = 1; cycle <= 3; ++cycle) {
    senses.begin_cycle({.number = cycle, .acted = {0.1 * cycle, 0.1 * cycle}});
    const Readings once = senses.read(Sensors::all());
    const Readings& twice = senses.read(Sensors::all());
    for (const Sensor sensor : kAllSensors)
      EXPECT_TRUE(same_reading(once, twice, sensor)) << static_cast<unsigned>(sensor);
  }
}

TEST(Sensors, ControlAndRecorderSeeTheSameReading) {
  const RichScene scene;
  RobotSenses senses = scene.senses();
  senses.begin_cycle({.number = 1});
  const Rgb ground = senses.ground_color();
  const ProximityReadings proximity = senses.proximity();
  const LightReadings light = senses.light();
  const Readings& readings = senses.read(Sensors::all());
  EXPECT_EQ(readings.ground_color, ground);
  EXPECT_THAT(proximity, testing::ElementsAreArray(readings.proximity_m));
  EXPECT_THAT(light, testing::ElementsAreArray(readings.light_lux));
}

/// One run of a machine that explores, in this profile.
struct Recorded {
  Flavour flavour = watermelon_argos3();
  Machine machine = parse_machine("--nstates 1 --s0 0 --rwm0 30", flavour).value();
  Profile profile;
  Mission mission = built_in_mission("aggregation").value();
  Instance instance;
  std::int64_t seed = 3;

  explicit Recorded(const char* profile_name) : profile(built_in_profile(profile_name).value()) {
    mission.cycles = 300;
    mission.arena.lights = {{.x_m = 0.5, .y_m = 0.5, .z_m = 1}};
    instance = instance_of(mission, seed).value();
  }
  Measured run(const Recorder& recorder) const {
    return simulate({machine, flavour, profile, mission, instance, seed}, recorder);
  }
};

TEST(RecordedSensors, ChangeNothing) {
  for (const char* profile : {"argos3", "rvr", "pseudo-reality"}) {
    const Recorded recorded(profile);
    const Measured plain = recorded.run({});
    int read = 0;
    const Measured watched = recorded.run(Recorder(
        [&](const Snapshot& now) {
          for (const RobotRecord& robot : now.robots)
            read += robot.readings != nullptr && robot.readings->lidar_m.size() == 719 ? 1 : 0;
        },
        Sensors::all()));
    EXPECT_EQ(read, 900);
    EXPECT_EQ(plain.score, watched.score) << profile;
    EXPECT_EQ(plain.state_digest, watched.state_digest) << profile;
  }
}

TEST(RecordedSensors, ThatWereNotAskedForAreNotRead) {
  const Recorded recorded("rvr");
  recorded.run([](const Snapshot& now) {
    for (const RobotRecord& robot : not_empty(now.robots))
      ASSERT_EQ(robot.readings, nullptr);
  });
}

TEST(RecordedSensors, AgreeWithTheTrajectory) {
  const Recorded recorded("argos3");
  std::vector<RobotRecord> before;
  double turned = 0;
  const auto check = [&](const Snapshot& now) {
    for (std::size_t i = 0; i < now.robots.size() && now.cycle > 0; ++i) {
      const RobotRecord& robot = now.robots[i];
      const Readings& readings = *robot.readings;
      const Pose& start = recorded.instance.starts[i];
      const double yaw = wrap_angle(robot.pose.theta - start.theta);
      ASSERT_EQ(readings.orientation.yaw_rad, robot.pose.theta);
      ASSERT_EQ(readings.position_m.x, robot.pose.x - start.x);
      ASSERT_EQ(readings.position_m.y, robot.pose.y - start.y);
      ASSERT_NEAR(readings.rotation.w, cos(yaw / 2), 1e-12);
      ASSERT_NEAR(readings.rotation.z, sin(yaw / 2), 1e-12);
      // The command of the cycle before is what acted since then.
      const Command& acted = before[i].command;
      const double speed = (acted.left_mps + acted.right_mps) / 2;
      ASSERT_NEAR(readings.velocity_mps.x, speed * cos(yaw), 1e-12);
      ASSERT_NEAR(readings.velocity_mps.y, speed * sin(yaw), 1e-12);
      const double spin =
          now.cycle == 1 ? 0 : wrap_angle(robot.pose.theta - before[i].pose.theta) / 0.1;
      ASSERT_NEAR(readings.spin_radps.z, spin, 1e-11);
      turned += std::fabs(spin);
      if (now.cycle == 1) {
        ASSERT_EQ(readings.acceleration_g, (Vector3{}));
      }
    }
    before.assign(now.robots.begin(), now.robots.end());
  };
  recorded.run(Recorder(check, Sensors::all()));
  EXPECT_GT(turned, 0);
}

}  // namespace
}  // namespace swarmsmith
