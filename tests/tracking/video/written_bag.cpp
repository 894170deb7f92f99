#include "tests/tracking/video/written_bag.h"

#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Temperature.h>

namespace swarmsmith {
namespace {

ros::Time ros_time(BagTime time) {
  ros::Time made;
  made.fromNSec(static_cast<std::uint64_t>(time));
  return made;
}

}  // namespace

struct WrittenBag::Inside {
  rosbag::Bag bag;
};

WrittenBag::WrittenBag(const std::string& path, const std::string& packing,
                       std::uint32_t chunk_bytes)
    : inside_(std::make_unique<Inside>()) {
  rosbag::Bag& bag = inside_->bag;
  bag.open(path, rosbag::bagmode::Write);
  bag.setChunkThreshold(chunk_bytes);
  if (packing == "bz2") bag.setCompression(rosbag::compression::BZ2);
  if (packing == "lz4") bag.setCompression(rosbag::compression::LZ4);
}

WrittenBag::~WrittenBag() = default;

void WrittenBag::add(const std::string& topic, const BagImage& image) {
  sensor_msgs::Image message;
  message.header.stamp = ros_time(image.stamp);
  message.header.frame_id = "ceiling";
  message.encoding = image.encoding;
  message.width = image.width;
  message.height = image.height;
  message.step = image.step;
  message.is_bigendian = image.is_big_endian ? 1 : 0;
  message.data = image.data;
  inside_->bag.write(topic, ros_time(image.recorded), message);
}

void WrittenBag::add(const std::string& topic, const BagPacked& image) {
  sensor_msgs::CompressedImage message;
  message.header.stamp = ros_time(image.stamp);
  message.header.frame_id = "ceiling";
  message.format = image.format;
  message.data = image.data;
  inside_->bag.write(topic, ros_time(image.recorded), message);
}

void WrittenBag::add_temperature(const std::string& topic, BagTime recorded) {
  inside_->bag.write(topic, ros_time(recorded), sensor_msgs::Temperature());
}

}  // namespace swarmsmith
