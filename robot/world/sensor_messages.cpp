#include "robot/world/sensor_messages.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "sim/control/lidar_clustering.h"

namespace swarmsmith {

namespace {

/// Limits of the YDLIDAR X4 (ros facts, 1.2).
constexpr double kLeastScan_m = 0.1;
constexpr double kMostScan_m = 12;

std::array<double, 3> channels_of(const Rgb& color) {
  return {static_cast<double>(color.r), static_cast<double>(color.g), static_cast<double>(color.b)};
}

std::vector<SeenRobot> seen_robots(Senses& senses) {
  std::vector<SeenRobot> robots;
  for (const Neighbour& neighbour : senses.neighbours())
    robots.push_back({neighbour.distance_m, neighbour.direction_x, neighbour.direction_y});
  return robots;
}

}  // namespace

SensesMessage senses_message(const Decider::Question& question, std::int64_t seed) {
  Senses& senses = question.senses;
  SensesMessage message;
  message.seed = seed;
  message.cycle = question.cycle;
  message.time_s = question.time_s;
  std::ranges::copy(senses.proximity().first<kRangeSensors>(), message.ranges_m.begin());
  message.color = channels_of(senses.ground_color());
  std::ranges::copy(senses.light().first<kRangeSensors>(), message.light_lux.begin());
  message.neighbours = seen_robots(senses);
  return message;
}

std::vector<ToRobot> driver_messages(const SensorTopics& sensors, SimulatedSenses& senses,
                                     std::int64_t stamp_ns) {
  const Arrival arrival{{}, stamp_ns};
  std::vector<ToRobot> messages;
  if (sensors.ranges) {
    const ProximityReadings ranges = senses.proximity();
    messages.emplace_back(RangesMessage{arrival, {ranges.begin(), ranges.end()}});
  }
  if (sensors.ground_color) {
    const auto [r, g, b] = channels_of(senses.ground_color());
    messages.emplace_back(GroundColorMessage{arrival, r, g, b});
  }
  if (sensors.scan) {
    constexpr double kIncrement_rad = 2 * kPi / kLidarRays;
    messages.emplace_back(ScanMessage{arrival, 0, kIncrement_rad * (kLidarRays - 1), kIncrement_rad,
                                      kLeastScan_m, kMostScan_m,
                                      senses.read(Sensor::Lidar).lidar_m});
  }
  if (sensors.neighbours) messages.emplace_back(NeighboursMessage{arrival, seen_robots(senses)});
  if (sensors.light) {
    const LightReadings lux = senses.light();
    messages.emplace_back(LightMessage{arrival, {lux.begin(), lux.end()}});
  }
  return messages;
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
