#include "tracking/video/internal/ros_image.h"

extern "C" {
#include <libavutil/imgutils.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/suggestion.h"
#include "tracking/rig/issue.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/still_picture.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

/// An encoding of sensor_msgs/image_encodings.h, and libav's formats for it, little-endian and
/// big-endian.
struct Encoding {
  std::string_view name;
  AVPixelFormat format = AV_PIX_FMT_NONE;
  AVPixelFormat big_endian = format;
};
constexpr std::array kEncodings = {
    Encoding{"mono8", AV_PIX_FMT_GRAY8},
    Encoding{"8UC1", AV_PIX_FMT_GRAY8},
    Encoding{"mono16", AV_PIX_FMT_GRAY16LE, AV_PIX_FMT_GRAY16BE},
    Encoding{"bgr8", AV_PIX_FMT_BGR24},
    Encoding{"8UC3", AV_PIX_FMT_BGR24},
    Encoding{"rgb8", AV_PIX_FMT_RGB24},
    Encoding{"bgra8", AV_PIX_FMT_BGR0},
    Encoding{"rgba8", AV_PIX_FMT_RGB0},
    Encoding{"bayer_rggb8", AV_PIX_FMT_BAYER_RGGB8},
    Encoding{"bayer_bggr8", AV_PIX_FMT_BAYER_BGGR8},
    Encoding{"bayer_gbrg8", AV_PIX_FMT_BAYER_GBRG8},
    Encoding{"bayer_grbg8", AV_PIX_FMT_BAYER_GRBG8},
    Encoding{"bayer_rggb16", AV_PIX_FMT_BAYER_RGGB16LE, AV_PIX_FMT_BAYER_RGGB16BE},
    Encoding{"bayer_bggr16", AV_PIX_FMT_BAYER_BGGR16LE, AV_PIX_FMT_BAYER_BGGR16BE},
    Encoding{"bayer_gbrg16", AV_PIX_FMT_BAYER_GBRG16LE, AV_PIX_FMT_BAYER_GBRG16BE},
    Encoding{"bayer_grbg16", AV_PIX_FMT_BAYER_GRBG16LE, AV_PIX_FMT_BAYER_GRBG16BE},
    Encoding{"yuv422", AV_PIX_FMT_UYVY422},
    Encoding{"yuv422_yuy2", AV_PIX_FMT_YUYV422},
};

/// The pixels are not copied from the message, which must outlive the picture.
Expected<av::FramePtr> raw_picture(const RosImage& message, const std::string& name) {
  const auto known = std::ranges::find(kEncodings, message.encoding, &Encoding::name);
  if (known == kEncodings.end()) {
    return unreadable(
        "its images have the encoding `" + shortened(message.encoding) +
            "`, which is not supported; mono8, mono16, bgr8, rgb8, bgra8, rgba8, bayer_ "
            "and yuv422 are",
        name);
  }
  const auto width = static_cast<int>(message.width);
  const auto height = static_cast<int>(message.height);
  if (auto fits = av::check_size(width, height, name); !fits) return Unexpected(fits.error());
  const AVPixelFormat format = message.is_big_endian ? known->big_endian : known->format;
  const int row = av_image_get_linesize(format, width, 0);
  const std::uint64_t needed = std::uint64_t{message.step} * (message.height - 1) +
                               static_cast<std::uint64_t>(std::max(row, 0));
  // The scaler needs rows at even addresses if samples have two bytes.
  const bool is_even = message.step % 2 == 0 || row / width % 2 != 0;
  if (row <= 0 || message.step < static_cast<std::uint32_t>(row) || !is_even ||
      needed > message.size) {
    return unreadable(fmt::format("an image of {} x {} {} has {} bytes, {} a row", width, height,
                                  message.encoding, message.size, message.step),
                      name);
  }
  av::FramePtr picture(av_frame_alloc());
  picture->width = width;
  picture->height = height;
  picture->format = format;
  picture->data[0] = message.data;
  picture->linesize[0] = static_cast<int>(message.step);
  return picture;
}

Expected<av::FramePtr> packed_picture(const RosImage& message, const std::string& name) {
  if (message.size == 0) return unreadable("an image without bytes", name);
  const av::PacketPtr packet(av_packet_alloc());
  packet->data = message.data;
  packet->size = static_cast<int>(message.size);
  return av::decode_still(*packet, name);
}

/// The first few names.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::vector<std::string> first;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    first.push_back(shortened(names[i]));
  return joined(first) +
         (names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "");
}

}  // namespace

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 100;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

std::optional<double> ros_seconds(std::uint32_t seconds, std::uint32_t nanoseconds) {
  constexpr double kNanoseconds = 1e9;
  if (seconds == 0 && nanoseconds == 0) return std::nullopt;
  return seconds + nanoseconds / kNanoseconds;
}

Expected<av::FramePtr> picture_of(const RosImage& image, const std::string& name) {
  return image.is_packed ? packed_picture(image, name) : raw_picture(image, name);
}

bool has_ros_images(std::string_view type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/msg/Image" || is_packed_type(type);
}

bool is_packed_type(std::string_view type) {
  return type == "sensor_msgs/CompressedImage" || type == "sensor_msgs/msg/CompressedImage";
}

Expected<std::string> image_topic(const std::map<std::string, std::string>& types,
                                  const BagWord& word) {
  std::vector<std::string> images;
  std::vector<std::string> all;
  for (const auto& [name, type] : types) {
    if (has_ros_images(type)) images.push_back(name);
    all.push_back(shortened(name) + " (" + type + ")");
  }
  if (images.empty()) {
    return unreadable(
        "there are no images in this bag; it has " + (all.empty() ? "no messages" : some_of(all)),
        word.file);
  }
  const auto found = types.find(word.topic);
  if (found != types.end() && has_ros_images(found->second)) return word.topic;
  if (word.topic.empty() && images.size() == 1) return images.front();
  std::string text = "the bag has several topics of images";
  if (found != types.end()) {
    text = "topic " + word.topic + " has no images, but " + found->second;
  } else if (!word.topic.empty()) {
    text = "the bag has no topic " + word.topic + did_you_mean(word.topic, images);
  }
  return Unexpected(error_of(IssueCode::Config,
                             text + "; name one, like " + word.file + ":" +
                                 shortened(images.front()) +
                                 "; those with images: " + some_of(images),
                             word.file));
}

}  // namespace swarmsmith
