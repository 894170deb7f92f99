#pragma once

#include <vector>

#include "robot/transport/messages.h"

namespace swarmsmith {

/// Messages as rows of numbers, as they travel where a transport has no type of its own for them
/// (docs/robot-messages.md). Arrivals are no part of them. `read_numbers` is false, and the message
/// untouched, when there are more or fewer numbers than the message has, or when one of them cannot
/// be what it stands for.

/// d, x, y of each.
std::vector<double> numbers_of(const NeighboursMessage& neighbours);
bool read_numbers(const std::vector<double>& numbers, NeighboursMessage& neighbours);

/// seed, cycle, time_s, 8 ranges, r, g, b, 8 lux, then d, x, y of each neighbour.
std::vector<double> numbers_of(const SensesMessage& senses);
bool read_numbers(const std::vector<double>& numbers, SensesMessage& senses);

/// seed, cycle, left, right, state.
std::vector<double> numbers_of(const AnswerMessage& answer);
bool read_numbers(const std::vector<double>& numbers, AnswerMessage& answer);

/// left, right, and the state where it is sent.
std::vector<double> numbers_of(const WheelsMessage& wheels);
bool read_numbers(const std::vector<double>& numbers, WheelsMessage& wheels);

/// r, g, b of each of the five.
std::vector<double> numbers_of(const LedsMessage& leds);
bool read_numbers(const std::vector<double>& numbers, LedsMessage& leds);

std::vector<double> numbers_of(const RangesMessage& ranges);
bool read_numbers(const std::vector<double>& numbers, RangesMessage& ranges);

std::vector<double> numbers_of(const GroundColorMessage& color);
bool read_numbers(const std::vector<double>& numbers, GroundColorMessage& color);

/// angle_min, angle_max, angle_increment, range_min, range_max, then the values.
std::vector<double> numbers_of(const ScanMessage& scan);
bool read_numbers(const std::vector<double>& numbers, ScanMessage& scan);

std::vector<double> numbers_of(const LightMessage& light);
bool read_numbers(const std::vector<double>& numbers, LightMessage& light);

/// Quaternion x, y, z, w; turn rates; accelerations.
std::vector<double> numbers_of(const ImuMessage& imu);
bool read_numbers(const std::vector<double>& numbers, ImuMessage& imu);

/// x, y, heading, vx, vy, turn rate.
std::vector<double> numbers_of(const OdometryMessage& odometry);
bool read_numbers(const std::vector<double>& numbers, OdometryMessage& odometry);

/// Voltage, charge.
std::vector<double> numbers_of(const BatteryMessage& battery);
bool read_numbers(const std::vector<double>& numbers, BatteryMessage& battery);

/// left, right.
std::vector<double> numbers_of(const DrivenMessage& driven);
bool read_numbers(const std::vector<double>& numbers, DrivenMessage& driven);

}  // namespace swarmsmith
