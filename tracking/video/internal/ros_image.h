#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// A ROS image, raw or compressed as JPEG or PNG.
struct RosImage {
  std::uint32_t stamp_s = 0;  ///< since 1970; no time if this and `stamp_ns` are 0
  std::uint32_t stamp_ns = 0;
  bool is_packed = false;
  std::string encoding;  ///< encoding of a raw image
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t step = 0;  ///< bytes from one row to the next
  bool is_big_endian = false;
  std::uint8_t* data = nullptr;  ///< followed by AV_INPUT_BUFFER_PADDING_SIZE more bytes
  std::size_t size = 0;
};

/// Seconds since 1970; nothing for 0. The same value as a decimal text with nine digits would give.
std::optional<double> ros_seconds(std::uint32_t seconds, std::uint32_t nanoseconds);

/// The pixels of an image. A raw image is not copied, so its bytes must outlive the picture.
/// E_VIDEO_UNREADABLE if the image cannot be read.
Expected<av::FramePtr> picture_of(const RosImage& image, const std::string& name);

/// Whether messages of this type are images: `sensor_msgs/Image`, `sensor_msgs/msg/Image` (ROS 2),
/// and the same with `CompressedImage`.
bool has_ros_images(std::string_view type);
bool is_packed_type(std::string_view type);

/// A text from a file, shortened for a message if it is long.
std::string shortened(const std::string& text);

/// Finds the topic of a bag that a user means, given the types of all topics by name: the named
/// topic, or the only one with images. E_CONFIG if none is named and there are several.
Expected<std::string> image_topic(const std::map<std::string, std::string>& types,
                                  const BagWord& word);

}  // namespace swarmsmith
