#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Also compiled as C++17, which the headers of ROS' messages want.

namespace swarmsmith {

/// Nanoseconds since 1970.
using BagTime = std::int64_t;

/// sensor_msgs/Image.
struct BagImage {
  BagTime recorded = 0;
  BagTime stamp = 0;
  std::string encoding = "mono8";
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t step = 0;
  bool is_big_endian = false;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/CompressedImage.
struct BagPacked {
  BagTime recorded = 0;
  BagTime stamp = 0;
  std::string format;
  std::vector<std::uint8_t> data;
};

/// A bag that is written by rosbag's own library, with the types of Debian's sensor_msgs. Closed by
/// its end.
class WrittenBag {
 public:
  /// `packing`: none, bz2 or lz4; a chunk is closed by the first message that makes it so large.
  explicit WrittenBag(const std::string& path, const std::string& packing = "none",
                      std::uint32_t chunk_bytes = 768 * 1024);
  ~WrittenBag();
  void add(const std::string& topic, const BagImage& image);
  void add(const std::string& topic, const BagPacked& image);
  /// A message that is not an image: sensor_msgs/Temperature.
  void add_temperature(const std::string& topic, BagTime recorded);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace swarmsmith
