#include "robot/world/sensor_messages.h"

#include <cmath>

#include "sim/control/lidar_clustering.h"

namespace swarmsmith {

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kStandardGravity_mps2 = 9.80665;
/// Of the YDLIDAR X4 (ros facts, 1.2).
constexpr double kLeastScan_m = 0.1;
constexpr double kMostScan_m = 12;

SeenRobot seen_robot(const Neighbour& neighbour) {
  return {neighbour.distance_m, neighbour.direction_x, neighbour.direction_y};
}

double yaw_of(const Quaternion& rotation) {
  return std::atan2(2 * (rotation.w * rotation.z + rotation.x * rotation.y),
                    1 - 2 * (rotation.y * rotation.y + rotation.z * rotation.z));
}

}  // namespace

SensesMessage senses_message(const Decider::Question& question, std::int64_t seed) {
  Senses& senses = question.senses;
  SensesMessage message;
  message.seed = seed;
  message.cycle = question.cycle;
  message.time_s = question.time_s;
  message.ranges_m = senses.proximity();
  const Rgb& color = senses.ground_color();
  message.color = {static_cast<double>(color.r), static_cast<double>(color.g),
                   static_cast<double>(color.b)};
  message.light_lux = senses.light();
  for (const Neighbour& neighbour : senses.neighbours())
    message.neighbours.push_back(seen_robot(neighbour));
  return message;
}

RangesMessage ranges_message(Senses& senses) {
  const ProximityReadings& ranges = senses.proximity();
  RangesMessage message;
  message.ranges_m.assign(ranges.begin(), ranges.end());
  return message;
}

GroundColorMessage ground_color_message(Senses& senses) {
  const Rgb& color = senses.ground_color();
  GroundColorMessage message;
  message.r = color.r;
  message.g = color.g;
  message.b = color.b;
  return message;
}

NeighboursMessage neighbours_message(Senses& senses) {
  NeighboursMessage message;
  for (const Neighbour& neighbour : senses.neighbours())
    message.robots.push_back(seen_robot(neighbour));
  return message;
}

LightMessage light_message(Senses& senses) {
  const LightReadings& lux = senses.light();
  LightMessage message;
  message.lux.assign(lux.begin(), lux.end());
  return message;
}

ScanMessage scan_message(SimulatedSenses& senses) {
  constexpr double kIncrement_rad = 2 * kPi / kLidarRays;
  ScanMessage message;
  message.angle_min_rad = 0;
  message.angle_max_rad = kIncrement_rad * (kLidarRays - 1);
  message.angle_increment_rad = kIncrement_rad;
  message.range_min_m = kLeastScan_m;
  message.range_max_m = kMostScan_m;
  message.ranges_m = senses.read(Sensor::Lidar).lidar_m;
  return message;
}

ImuMessage imu_message(SimulatedSenses& senses) {
  const Readings& readings =
      senses.read(Sensor::Accelerometer | Sensor::Gyroscope | Sensor::Quaternion);
  ImuMessage message;
  const Quaternion& q = readings.rotation;
  message.orientation = {q.x, q.y, q.z, q.w};
  const Vector3& spin = readings.spin_radps;
  message.angular_velocity_radps = {spin.x, spin.y, spin.z};
  const Vector3& g = readings.acceleration_g;
  message.acceleration_mps2 = {g.x * kStandardGravity_mps2, g.y * kStandardGravity_mps2,
                               g.z * kStandardGravity_mps2};
  return message;
}

OdometryMessage odometry_message(SimulatedSenses& senses) {
  const Readings& readings = senses.read(Sensor::Locator | Sensor::Quaternion |
                                         Sensors(Sensor::Velocity) | Sensor::Gyroscope);
  OdometryMessage message;
  message.x_m = readings.position_m.x;
  message.y_m = readings.position_m.y;
  message.heading_rad = yaw_of(readings.rotation);
  message.vx_mps = readings.velocity_mps.x;
  message.vy_mps = readings.velocity_mps.y;
  message.turn_radps = readings.spin_radps.z;
  return message;
}

std::int64_t stamp_of_time(double time_s) {
  constexpr std::int64_t kStep_ns = 10'000'000;
  constexpr double kStepsPerSecond = 100;
  return (std::llround(time_s * kStepsPerSecond) + 1) * kStep_ns;
}

SensorTopics world_topics() {
  SensorTopics topics;
  topics.neighbours = true;
  return topics;
}

}  // namespace swarmsmith
