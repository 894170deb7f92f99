#include "sim/engine/internal/motion_sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;

Quaternion about_z(double angle) {
  return {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
}

/// The product of Hamilton.
Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion inverse(const Quaternion& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

TEST(VelocitySensor, TurnsTheMeanTreadSpeedByTheYawSinceTheStart) {
  const MotionSensors sensors(body_at({1, 2, 30 * kDegree}));
  const Vector3 v = sensors.velocity(body_at({0, 0, 90 * kDegree}), {0.2, 0.4});
  EXPECT_NEAR(v.x, 0.3 * 0.5, 1e-15);
  EXPECT_NEAR(v.y, 0.3 * std::sqrt(3) / 2, 1e-15);
  EXPECT_EQ(v.z, 0);
}

TEST(VelocitySensor, ReadsTheSetPointsNotTheBody) {
  const MotionSensors sensors(body_at({0, 0, 0}));
  Body rolling = body_at({0, 0, 0});
  rolling.vx = 0.3;
  EXPECT_EQ(sensors.velocity(rolling, {0, 0}), (Vector3{0, 0, 0}));
  EXPECT_EQ(sensors.velocity(rolling, {-0.3, 0.3}), (Vector3{0, 0, 0})) << "turns on the spot";
}

TEST(Accelerometer, DividesTheChangeOfVelocityByTickAndGravity) {
  MotionSensors sensors(body_at({0, 0, 45 * kDegree}));
  // From rest, which is v before the first cycle, to 0.3 m/s: 0.3 / (9.81 * 0.1) g.
  const Vector3 start = sensors.acceleration(body_at({0, 0, 45 * kDegree}), {0.3, 0.3});
  EXPECT_NEAR(start.x, 0.305810397553517, 1e-14);
  EXPECT_NEAR(start.y, 0, 1e-15);
  // The same speed after a quarter turn: (0, 0.3) - (0.3, 0).
  const Vector3 turn = sensors.acceleration(body_at({0, 0, 135 * kDegree}), {0.3, 0.3});
  EXPECT_NEAR(turn.x, -0.305810397553517, 1e-14);
  EXPECT_NEAR(turn.y, 0.305810397553517, 1e-14);
  const Vector3 steady = sensors.acceleration(body_at({0, 0, 135 * kDegree}), {0.3, 0.3});
  EXPECT_EQ(steady, (Vector3{0, 0, 0}));
}

TEST(Gyroscope, FirstReadsZeroThenTheTurnATick) {
  MotionSensors sensors(body_at({0, 0, 1.0}));
  EXPECT_EQ(sensors.spin(body_at({0, 0, 1.5})), (Vector3{0, 0, 0}));
  EXPECT_NEAR(sensors.spin(body_at({0, 0, 1.7})).z, 2, 1e-13);
  EXPECT_NEAR(sensors.spin(body_at({0, 0, 1.6})).z, -1, 1e-13);
  EXPECT_EQ(sensors.spin(body_at({0, 0, 1.6})), (Vector3{0, 0, 0})) << "stands";
}

TEST(Gyroscope, WrapsTheDifferenceOfYaw) {
  MotionSensors sensors(body_at({0, 0, 3.0}));
  sensors.spin(body_at({0, 0, 3.0}));
  EXPECT_NEAR(sensors.spin(body_at({0, 0, -3.0})).z, (2 * kPi - 6) / 0.1, 1e-12);
}

TEST(Imu, ReadsTheHeadingInTheArenasFrame) {
  for (const double theta : {0.0, 0.5, 3.0, -3.0, kPi}) {
    const Orientation orientation = MotionSensors::orientation(body_at({1, 1, theta}));
    EXPECT_NEAR(orientation.yaw_rad, theta, 1e-15);
    EXPECT_EQ(orientation.pitch_rad, 0);
    EXPECT_EQ(orientation.roll_rad, 0);
  }
}

TEST(Locator, ReadsTheWayFromTheStartAlongTheArenasAxes) {
  const MotionSensors sensors(body_at({1, -0.5, 2.0}));
  EXPECT_EQ(sensors.position(body_at({0.25, 0.5, -1.0})), (Point{-0.75, 1.0}));
}

TEST(QuaternionSensor, IsTheProductOfTheFormula) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const double start = rng.uniform(-kPi, kPi);
    const double now = rng.uniform(-kPi, kPi);
    Quaternion want = product(inverse(about_z(start)), about_z(now));
    if (want.w < 0) want = {-want.w, -want.x, -want.y, -want.z};  // the same rotation
    const Quaternion got = MotionSensors(body_at({0, 0, start})).rotation(body_at({0, 0, now}));
    EXPECT_NEAR(got.w, want.w, 1e-14);
    EXPECT_NEAR(got.z, want.z, 1e-14);
    EXPECT_EQ(got.x, 0);
    EXPECT_EQ(got.y, 0);
    EXPECT_NEAR(got.w * got.w + got.z * got.z, 1, 1e-15);
  }
}

TEST(QuaternionSensor, IsOneAtTheStart) {
  const Body start = body_at({0, 0, 0.7});
  EXPECT_EQ(MotionSensors(start).rotation(start), (Quaternion{1, 0, 0, 0}));
}

}  // namespace
}  // namespace swarmsmith
