#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

/// teraranger_array/RangeArray, which no ROS package provides: the message of the proximity
/// sensors' driver (ros facts, 1.2 and 2.3).
namespace teraranger_array {

struct RangeArray {
  std_msgs::Header header;
  std::vector<sensor_msgs::Range> ranges;
};

}  // namespace teraranger_array

namespace ros {
namespace message_traits {

template <>
struct IsMessage<teraranger_array::RangeArray> : TrueType {};
template <>
struct IsMessage<const teraranger_array::RangeArray> : TrueType {};
template <>
struct HasHeader<teraranger_array::RangeArray> : TrueType {};
template <>
struct HasHeader<const teraranger_array::RangeArray> : TrueType {};

template <>
struct MD5Sum<teraranger_array::RangeArray> {
  static const char* value() { return "4c1d9b3ff03219d31e41c86817a72ba8"; }
  static const char* value(const teraranger_array::RangeArray& /*message*/) { return value(); }
};

template <>
struct DataType<teraranger_array::RangeArray> {
  static const char* value() { return "teraranger_array/RangeArray"; }
  static const char* value(const teraranger_array::RangeArray& /*message*/) { return value(); }
};

/// The full definition, including the types inside: bags and tools decode messages with it.
template <>
struct Definition<teraranger_array::RangeArray> {
  static const char* value() {
    static const std::string kText = "Header header\nsensor_msgs/Range[] ranges\n\n" +
                                     std::string(80, '=') + "\nMSG: sensor_msgs/Range\n" +
                                     Definition<sensor_msgs::Range>::value();
    return kText.c_str();
  }
  static const char* value(const teraranger_array::RangeArray& /*message*/) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<teraranger_array::RangeArray> {
  template <typename Stream, typename Message>
  inline static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.ranges);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
