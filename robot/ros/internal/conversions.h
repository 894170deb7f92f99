#pragma once

#include <geometry_msgs/Twist.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "robot/ros/internal/range_array.h"
#include "robot/transport/numbers.h"
#include "sim/control/treads.h"

namespace swarmsmith {

/// Converts messages to ROS messages (docs/robot-messages.md) and back: `to_ros(ours, theirs)` and
/// `from_ros(theirs, ours)`, which is false when `theirs` is not a valid message. Arrivals are not
/// converted, except for the header's stamp. Where ROS has no suitable type, messages are rows of
/// numbers.

/// From the driver of the proximity sensors (ros facts, 1.2).
constexpr float kRangeFieldOfView_rad = 0.2967F;
constexpr float kLeastRange_m = 0.05F;
constexpr float kMostRange_m = 2.0F;

/// The ROS type of a message; wheels have several.
template <class Ours>
std_msgs::Float64MultiArray type_of(const Ours&);
teraranger_array::RangeArray type_of(const RangesMessage&);
std_msgs::ColorRGBA type_of(const GroundColorMessage&);
sensor_msgs::LaserScan type_of(const ScanMessage&);
sensor_msgs::BatteryState type_of(const BatteryMessage&);
std_msgs::Float32MultiArray type_of(const LedsMessage&);
std_msgs::String type_of(const OrderMessage&);
std_msgs::String type_of(const StateMessage&);
template <class Ours>
using RosType = decltype(type_of(std::declval<const Ours&>()));

inline std::int64_t nanoseconds(const ros::Time& stamp) {
  return std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nsec;
}

/// Times before 1970, for which ROS has no stamps, become 0, which means none.
inline ros::Time stamp_of(const Arrival& arrival) {
  ros::Time stamp;
  if (arrival.stamp_ns > 0) stamp.fromNSec(static_cast<std::uint64_t>(arrival.stamp_ns));
  return stamp;
}

template <class Ours>
void to_ros(const Ours& ours, std_msgs::Float64MultiArray& theirs) {
  theirs.data = numbers_of(ours);
}
template <class Ours>
void to_ros(const Ours& ours, std_msgs::Float32MultiArray& theirs) {
  for (const double number : numbers_of(ours))
    theirs.data.push_back(static_cast<float>(number));
}
template <class Theirs, class Ours>
auto from_ros(const Theirs& theirs, Ours& ours)
    -> std::enable_if_t<std::is_arithmetic_v<typename decltype(theirs.data)::value_type>, bool> {
  return read_numbers({theirs.data.begin(), theirs.data.end()}, ours);
}

template <class Ours>
void to_ros(const Ours& ours, std_msgs::String& theirs) {
  theirs.data = ours.text;
}
template <class Ours>
bool from_ros(const std_msgs::String& theirs, Ours& ours) {
  ours.text = theirs.data;
  return true;
}

/// A differential drive: forward speed (l + r) / 2, turning speed (r - l) / distance of the treads.
inline void to_ros(const WheelsMessage& ours, geometry_msgs::Twist& theirs) {
  theirs.linear.x = (ours.left_mps + ours.right_mps) / 2;
  theirs.angular.z = (ours.right_mps - ours.left_mps) / kTreadDistance_m;
}
inline bool from_ros(const geometry_msgs::Twist& theirs, WheelsMessage& ours) {
  const double half = theirs.angular.z * kTreadDistance_m / 2;
  ours.left_mps = theirs.linear.x - half;
  ours.right_mps = theirs.linear.x + half;
  return true;
}

/// One of the sensors of `ours`.
inline sensor_msgs::Range range_of(const RangesMessage& ours, std::size_t sensor) {
  sensor_msgs::Range theirs;
  theirs.header.stamp = stamp_of(ours.arrival);
  theirs.header.frame_id = "base_range_" + std::to_string(sensor);
  theirs.radiation_type = sensor_msgs::Range::INFRARED;
  theirs.field_of_view = kRangeFieldOfView_rad;
  theirs.min_range = kLeastRange_m;
  theirs.max_range = kMostRange_m;
  theirs.range = static_cast<float>(ours.ranges_m[sensor]);
  return theirs;
}
inline void to_ros(const RangesMessage& ours, teraranger_array::RangeArray& theirs) {
  theirs.header.stamp = stamp_of(ours.arrival);
  theirs.header.frame_id = "base_hub";
  for (std::size_t i = 0; i < ours.ranges_m.size(); ++i)
    theirs.ranges.push_back(range_of(ours, i));
}
inline bool from_ros(const teraranger_array::RangeArray& theirs, RangesMessage& ours) {
  ours.arrival.stamp_ns = nanoseconds(theirs.header.stamp);
  for (const sensor_msgs::Range& range : theirs.ranges)
    ours.ranges_m.push_back(double{range.range});
  return true;
}

inline void to_ros(const GroundColorMessage& ours, std_msgs::ColorRGBA& theirs) {
  theirs.r = static_cast<float>(ours.r);
  theirs.g = static_cast<float>(ours.g);
  theirs.b = static_cast<float>(ours.b);
  theirs.a = 255;
}
inline bool from_ros(const std_msgs::ColorRGBA& theirs, GroundColorMessage& ours) {
  ours.r = double{theirs.r};
  ours.g = double{theirs.g};
  ours.b = double{theirs.b};
  return true;
}

inline void to_ros(const ScanMessage& ours, sensor_msgs::LaserScan& theirs) {
  theirs.header.stamp = stamp_of(ours.arrival);
  theirs.header.frame_id = "laser_frame";
  theirs.angle_min = static_cast<float>(ours.angle_min_rad);
  theirs.angle_max = static_cast<float>(ours.angle_max_rad);
  theirs.angle_increment = static_cast<float>(ours.angle_increment_rad);
  theirs.range_min = static_cast<float>(ours.range_min_m);
  theirs.range_max = static_cast<float>(ours.range_max_m);
  for (const double range_m : ours.ranges_m)
    theirs.ranges.push_back(static_cast<float>(range_m));
}
inline bool from_ros(const sensor_msgs::LaserScan& theirs, ScanMessage& ours) {
  const Arrival arrival{ours.arrival.at, nanoseconds(theirs.header.stamp)};
  ours = {arrival,
          double{theirs.angle_min},
          double{theirs.angle_max},
          double{theirs.angle_increment},
          double{theirs.range_min},
          double{theirs.range_max},
          {theirs.ranges.begin(), theirs.ranges.end()}};
  return true;
}

inline void to_ros(const BatteryMessage& ours, sensor_msgs::BatteryState& theirs) {
  theirs.header.stamp = stamp_of(ours.arrival);
  theirs.voltage = static_cast<float>(ours.voltage_V);
  theirs.percentage = static_cast<float>(ours.charge);
}
inline bool from_ros(const sensor_msgs::BatteryState& theirs, BatteryMessage& ours) {
  ours.arrival.stamp_ns = nanoseconds(theirs.header.stamp);
  ours.voltage_V = double{theirs.voltage};
  ours.charge = double{theirs.percentage};
  return true;
}

}  // namespace swarmsmith
