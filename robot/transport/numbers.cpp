#include "robot/transport/numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swarmsmith {

namespace {

/// Whole numbers up to here are doubles.
constexpr double kLargestWhole = 9007199254740992.0;

bool read_whole(double number, std::int64_t& whole) {
  if (!(number >= -kLargestWhole && number <= kLargestWhole) || number != std::floor(number))
    return false;
  whole = static_cast<std::int64_t>(number);
  return true;
}

bool read_state(double number, int& state) {
  constexpr double kMostStates = 1000;
  if (!(number >= 0 && number <= kMostStates) || number != std::floor(number)) return false;
  state = static_cast<int>(number);
  return true;
}

void add(std::vector<double>& numbers, const std::vector<SeenRobot>& robots) {
  for (const SeenRobot& robot : robots)
    numbers.insert(numbers.end(), {robot.distance_m, robot.direction_x, robot.direction_y});
}

/// From `at` to the end.
bool read_robots(const std::vector<double>& numbers, std::size_t at,
                 std::vector<SeenRobot>& robots) {
  if (numbers.size() < at || (numbers.size() - at) % 3 != 0) return false;
  robots.clear();
  for (std::size_t i = at; i < numbers.size(); i += 3)
    robots.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return true;
}

template <std::size_t N>
void read_array(const std::vector<double>& numbers, std::size_t at, std::array<double, N>& array) {
  std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(at), N, array.begin());
}

}  // namespace

std::vector<double> numbers_of(const NeighboursMessage& neighbours) {
  std::vector<double> numbers;
  add(numbers, neighbours.robots);
  return numbers;
}

bool read_numbers(const std::vector<double>& numbers, NeighboursMessage& neighbours) {
  return read_robots(numbers, 0, neighbours.robots);
}

namespace {

constexpr std::size_t kSensesBeforeNeighbours = 3 + kRangeSensors + 3 + kRangeSensors;

}  // namespace

std::vector<double> numbers_of(const SensesMessage& senses) {
  std::vector<double> numbers{static_cast<double>(senses.seed), static_cast<double>(senses.cycle),
                              senses.time_s};
  numbers.reserve(kSensesBeforeNeighbours + 3 * senses.neighbours.size());
  numbers.insert(numbers.end(), senses.ranges_m.begin(), senses.ranges_m.end());
  numbers.insert(numbers.end(), senses.color.begin(), senses.color.end());
  numbers.insert(numbers.end(), senses.light_lux.begin(), senses.light_lux.end());
  add(numbers, senses.neighbours);
  return numbers;
}

bool read_numbers(const std::vector<double>& numbers, SensesMessage& senses) {
  if (numbers.size() < kSensesBeforeNeighbours) return false;
  SensesMessage read;
  if (!read_whole(numbers[0], read.seed) || !read_whole(numbers[1], read.cycle)) return false;
  read.time_s = numbers[2];
  std::size_t at = 3;
  read_array(numbers, at, read.ranges_m);
  at += kRangeSensors;
  read_array(numbers, at, read.color);
  at += 3;
  read_array(numbers, at, read.light_lux);
  if (!read_robots(numbers, kSensesBeforeNeighbours, read.neighbours)) return false;
  read.arrival = senses.arrival;
  senses = std::move(read);
  return true;
}

std::vector<double> numbers_of(const AnswerMessage& answer) {
  return {static_cast<double>(answer.seed), static_cast<double>(answer.cycle), answer.left_mps,
          answer.right_mps, static_cast<double>(answer.state)};
}

bool read_numbers(const std::vector<double>& numbers, AnswerMessage& answer) {
  AnswerMessage read;
  if (numbers.size() != 5 || !read_whole(numbers[0], read.seed) ||
      !read_whole(numbers[1], read.cycle) || !read_state(numbers[4], read.state))
    return false;
  read.left_mps = numbers[2];
  read.right_mps = numbers[3];
  read.arrival = answer.arrival;
  answer = read;
  return true;
}

std::vector<double> numbers_of(const WheelsMessage& wheels) {
  std::vector<double> numbers{wheels.left_mps, wheels.right_mps};
  if (wheels.state >= 0) numbers.push_back(wheels.state);
  return numbers;
}

bool read_numbers(const std::vector<double>& numbers, WheelsMessage& wheels) {
  int state = -1;
  if (numbers.size() != 2 && (numbers.size() != 3 || !read_state(numbers[2], state))) return false;
  wheels.left_mps = numbers[0];
  wheels.right_mps = numbers[1];
  wheels.state = state;
  return true;
}

std::vector<double> numbers_of(const LedsMessage& leds) {
  return {leds.colors.begin(), leds.colors.end()};
}

bool read_numbers(const std::vector<double>& numbers, LedsMessage& leds) {
  if (numbers.size() != leds.colors.size()) return false;
  read_array(numbers, 0, leds.colors);
  return true;
}

std::vector<double> numbers_of(const RangesMessage& ranges) {
  return ranges.ranges_m;
}

bool read_numbers(const std::vector<double>& numbers, RangesMessage& ranges) {
  ranges.ranges_m = numbers;
  return true;
}

std::vector<double> numbers_of(const GroundColorMessage& color) {
  return {color.r, color.g, color.b};
}

bool read_numbers(const std::vector<double>& numbers, GroundColorMessage& color) {
  if (numbers.size() != 3) return false;
  color.r = numbers[0];
  color.g = numbers[1];
  color.b = numbers[2];
  return true;
}

std::vector<double> numbers_of(const ScanMessage& scan) {
  std::vector<double> numbers{scan.angle_min_rad, scan.angle_max_rad, scan.angle_increment_rad,
                              scan.range_min_m, scan.range_max_m};
  numbers.insert(numbers.end(), scan.ranges_m.begin(), scan.ranges_m.end());
  return numbers;
}

bool read_numbers(const std::vector<double>& numbers, ScanMessage& scan) {
  constexpr std::ptrdiff_t kBefore = 5;
  if (numbers.size() < kBefore) return false;
  scan.angle_min_rad = numbers[0];
  scan.angle_max_rad = numbers[1];
  scan.angle_increment_rad = numbers[2];
  scan.range_min_m = numbers[3];
  scan.range_max_m = numbers[4];
  scan.ranges_m.assign(numbers.begin() + kBefore, numbers.end());
  return true;
}

std::vector<double> numbers_of(const LightMessage& light) {
  return light.lux;
}

bool read_numbers(const std::vector<double>& numbers, LightMessage& light) {
  light.lux = numbers;
  return true;
}

std::vector<double> numbers_of(const ImuMessage& imu) {
  std::vector<double> numbers(imu.orientation.begin(), imu.orientation.end());
  numbers.insert(numbers.end(), imu.angular_velocity_radps.begin(),
                 imu.angular_velocity_radps.end());
  numbers.insert(numbers.end(), imu.acceleration_mps2.begin(), imu.acceleration_mps2.end());
  return numbers;
}

bool read_numbers(const std::vector<double>& numbers, ImuMessage& imu) {
  if (numbers.size() != 10) return false;
  read_array(numbers, 0, imu.orientation);
  read_array(numbers, 4, imu.angular_velocity_radps);
  read_array(numbers, 7, imu.acceleration_mps2);
  return true;
}

std::vector<double> numbers_of(const OdometryMessage& odometry) {
  return {odometry.x_m,    odometry.y_m,    odometry.heading_rad,
          odometry.vx_mps, odometry.vy_mps, odometry.turn_radps};
}

bool read_numbers(const std::vector<double>& numbers, OdometryMessage& odometry) {
  if (numbers.size() != 6) return false;
  const Arrival arrival = odometry.arrival;
  odometry = {arrival, numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
  return true;
}

std::vector<double> numbers_of(const DrivenMessage& driven) {
  return {driven.left_mps, driven.right_mps};
}

bool read_numbers(const std::vector<double>& numbers, DrivenMessage& driven) {
  if (numbers.size() != 2) return false;
  driven.left_mps = numbers[0];
  driven.right_mps = numbers[1];
  return true;
}

std::vector<double> numbers_of(const BatteryMessage& battery) {
  return {battery.voltage_V, battery.charge};
}

bool read_numbers(const std::vector<double>& numbers, BatteryMessage& battery) {
  if (numbers.size() != 2) return false;
  battery.voltage_V = numbers[0];
  battery.charge = numbers[1];
  return true;
}

}  // namespace swarmsmith
