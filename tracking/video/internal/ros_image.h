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

/// An image as ROS sends it, raw or packed as JPEG or PNG.
struct RosImage {
  std::uint32_t stamp_s = 0;  ///< since 1970; 0 with `stamp_ns`: none
  std::uint32_t stamp_ns = 0;
  bool is_packed = false;
  std::string encoding;  ///< of raw ones
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t step = 0;  ///< bytes from row to row
  bool is_big_endian = false;
  std::uint8_t* data = nullptr;  ///< with AV_INPUT_BUFFER_PADDING_SIZE bytes after it
  std::size_t size = 0;
};

/// Seconds since 1970; nothing for 0. What a text with nine digits reads as.
std::optional<double> ros_seconds(std::uint32_t seconds, std::uint32_t nanoseconds);

/// The pixels; of raw images where they lie, so that those must outlive the picture.
/// E_VIDEO_UNREADABLE for what is not read.
Expected<av::FramePtr> picture_of(const RosImage& image, const std::string& name);

/// Whether messages of this type are images: `sensor_msgs/Image`, `sensor_msgs/msg/Image` (ROS 2),
/// and the same with `CompressedImage`.
bool has_ros_images(std::string_view type);
bool is_packed_type(std::string_view type);

/// A text of a file for a sentence: its beginning when it is long.
std::string shortened(const std::string& text);

/// Which of a bag's topics, by name and type, a word means: the one that it names, or the only one
/// with images. E_CONFIG for none among several.
Expected<std::string> image_topic(const std::map<std::string, std::string>& types,
                                  const BagWord& word);

}  // namespace swarmsmith
