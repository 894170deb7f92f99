#include "tracking/video/internal/bag_file.h"

extern "C" {
#include <libavutil/imgutils.h>
}

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/suggestion.h"
#include "tracking/rig/issue.h"
#include "tracking/video/internal/bag_check.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/still_picture.h"

namespace swarmsmith {
namespace {

Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

/// A kind of message with an image in it; the sum is that of its definition.
struct ImageType {
  std::string_view name;
  std::string_view md5;
};
constexpr ImageType kRaw{"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"};
constexpr ImageType kPacked{"sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f"};

struct Topic {
  std::string type;
  std::string md5;
  bool has_images() const { return type == kRaw.name || type == kPacked.name; }
};

bool unpack_chunk(const std::string& packing, std::string& packed, std::string& into) {
  if (packing != rosbag::COMPRESSION_BZ2 && packing != rosbag::COMPRESSION_LZ4) return false;
  const auto bytes = [](std::string& text) { return reinterpret_cast<std::uint8_t*>(text.data()); };
  try {
    rosbag::ChunkedFile().decompress(
        packing == rosbag::COMPRESSION_BZ2 ? rosbag::compression::BZ2 : rosbag::compression::LZ4,
        bytes(into), static_cast<unsigned>(into.size()), bytes(packed),
        static_cast<unsigned>(packed.size()));
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// Those with messages, by their names.
std::map<std::string, Topic> topics_of(const rosbag::Bag& bag) {
  std::map<std::string, Topic> topics;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    topics[connection->topic] = {connection->datatype, connection->md5sum};
  return topics;
}

Expected<std::string> topic_of(const std::map<std::string, Topic>& topics, const BagWord& word) {
  std::vector<std::string> images;
  std::vector<std::string> all;
  for (const auto& [name, topic] : topics) {
    if (topic.has_images()) images.push_back(name);
    all.push_back(name + " (" + topic.type + ")");
  }
  if (images.empty()) {
    return unreadable(
        "there are no images in this bag; it has " + (all.empty() ? "no messages" : joined(all)),
        word.file);
  }
  const auto found = topics.find(word.topic);
  if (found != topics.end() && found->second.has_images()) return word.topic;
  if (word.topic.empty() && images.size() == 1) return images.front();
  std::string text = "the bag has several topics of images";
  if (found != topics.end()) {
    text = "topic " + word.topic + " has no images, but " + found->second.type;
  } else if (!word.topic.empty()) {
    text = "the bag has no topic " + word.topic + did_you_mean(word.topic, images);
  }
  return Unexpected(error_of(IssueCode::Config,
                             text + "; name one, like " + word.file + ":" + images.front() +
                                 "; those with images: " + joined(images),
                             word.file));
}

/// Takes a message as it lies in the bag.
struct MessageBytes {
  std::vector<std::uint8_t> bytes;
  std::uint32_t size = 0;

  std::uint8_t* advance(std::uint32_t count) {
    constexpr std::uint32_t kMostBytes = 400U << 20;
    if (count > kMostBytes) throw rosbag::BagFormatException("a message of more than 400 MB");
    size = count;
    // Decoders and scalers read a little beyond the end.
    bytes.resize(std::size_t{count} + AV_INPUT_BUFFER_PADDING_SIZE);
    return bytes.data();
  }
};

struct Message {
  ros::Time stamp;
  std::string encoding;  ///< of raw ones
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t step = 0;  ///< bytes from row to row
  bool is_big_endian = false;
  std::uint8_t* data = nullptr;
  std::uint32_t size = 0;
};

/// Throws when it ends too early. The definitions are those of `sensor_msgs`.
Message read_message(MessageBytes& from, bool is_packed) {
  Message message;
  ros::serialization::IStream in(from.bytes.data(), from.size);
  std::uint32_t number = 0;
  std::string text;
  std::uint8_t flag = 0;
  in.next(number);
  in.next(message.stamp);
  in.next(text);  // the frame of coordinates
  if (is_packed) {
    in.next(text);  // the format, which the bytes say better
  } else {
    in.next(message.height);
    in.next(message.width);
    in.next(message.encoding);
    in.next(flag);
    in.next(message.step);
    message.is_big_endian = flag != 0;
  }
  in.next(message.size);
  message.data = in.advance(message.size);
  return message;
}

/// What an encoding of sensor_msgs/image_encodings.h is called by libav, with its low byte first
/// and last.
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

/// The pixels where they lie in the message, which must outlive the picture.
Expected<av::FramePtr> raw_picture(const Message& message, const std::string& name) {
  const auto known = std::ranges::find(kEncodings, message.encoding, &Encoding::name);
  if (known == kEncodings.end()) {
    return unreadable("its images have the encoding `" + message.encoding +
                          "`, which is not read; mono8, mono16, bgr8, rgb8, bgra8, rgba8, bayer_ "
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
  // The scaler steps through samples of two bytes.
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

Expected<av::FramePtr> packed_picture(const Message& message, const std::string& name) {
  if (message.size == 0) return unreadable("an image without bytes", name);
  const av::PacketPtr packet(av_packet_alloc());
  packet->data = message.data;
  packet->size = static_cast<int>(message.size);
  return av::decode_still(*packet, name);
}

/// The messages of a topic, one after the other.
class Messages {
 public:
  Messages(std::unique_ptr<rosbag::Bag> bag, std::string topic) : topic_(std::move(topic)) {
    use(std::move(bag));
  }

  std::int64_t count() { return view_->size(); }
  bool has_next() { return next_ != view_->end(); }
  void rewind() { next_ = view_->begin(); }
  /// The next one's bytes, and when it was recorded. Goes on, also where it throws for damage.
  ros::Time take(MessageBytes& into) {
    rosbag::View::iterator taken = next_++;
    if (has_failed_) {
      // After a chunk that it could not unpack, the library takes what it got for the chunk before.
      const std::int64_t left = std::distance(next_, view_->end());
      use(std::make_unique<rosbag::Bag>(bag_->getFileName()));
      taken = std::next(view_->begin(), count() - left - 1);
      next_ = std::next(taken);
    }
    has_failed_ = true;
    taken->write(into);
    has_failed_ = false;
    return taken->getTime();
  }

 private:
  void use(std::unique_ptr<rosbag::Bag> bag) {
    view_ = std::make_unique<rosbag::View>(*bag, rosbag::TopicQuery(topic_));
    bag_ = std::move(bag);
    rewind();
  }

  std::string topic_;
  std::unique_ptr<rosbag::Bag> bag_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  bool has_failed_ = false;
};

class BagFile final : public FrameSource {
 public:
  BagFile(std::string name, std::unique_ptr<rosbag::Bag> bag, const std::string& topic,
          bool is_packed)
      : is_packed_(is_packed), messages_(std::move(bag), topic) {
    info_.name = std::move(name);
    info_.expected_frames = messages_.count();
    info_.has_times = true;
  }

  /// Looks at the first image that can be read: how large they are, and whether they have stamps.
  Expected<void> look() {
    std::optional<Error> first_error;
    while (messages_.has_next()) {
      const auto read = read_next();
      if (read) {
        info_.size = {picture_->width, picture_->height};
        if (!pictures_.gray(*picture_)) return unreadable(kNotRead, info_.name);
        has_stamps_ = !message_.stamp.isZero();
        messages_.rewind();
        return {};
      }
      if (!first_error) first_error = read.error();
    }
    return Unexpected(*first_error);
  }

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return pictures_.color(*picture_); }
  std::int64_t damaged_frames() const override { return damaged_; }

  Expected<bool> next() override {
    while (messages_.has_next()) {
      const std::int64_t number = number_++;
      const auto read = read_next();
      if (!read) {
        ++damaged_;
        continue;
      }
      if (picture_->width != info_.size.width || picture_->height != info_.size.height) {
        return unreadable(
            fmt::format("image {} is {} x {} pixels, those before it {} x {}", number,
                        picture_->width, picture_->height, info_.size.width, info_.size.height),
            info_.name);
      }
      const auto gray = pictures_.gray(*picture_);
      if (!gray) return unreadable(kNotRead, info_.name);
      frame_ = {.number = number,
                .time_s = seconds(has_stamps_ ? message_.stamp : recorded_),
                .gray = *gray};
      return true;
    }
    return false;
  }

 private:
  static constexpr const char* kNotRead = "its pixel format cannot be read";

  /// Since 1970. One division and one sum: what a text with nine digits reads as.
  static std::optional<double> seconds(const ros::Time& time) {
    constexpr double kNanoseconds = 1e9;
    if (time.isZero()) return std::nullopt;
    return time.sec + time.nsec / kNanoseconds;
  }

  Expected<void> read_next() {
    try {
      recorded_ = messages_.take(bytes_);
      message_ = read_message(bytes_, is_packed_);
    } catch (const std::exception& error) {
      return unreadable(std::string("an image cannot be read: ") + error.what(), info_.name);
    }
    auto picture =
        is_packed_ ? packed_picture(message_, info_.name) : raw_picture(message_, info_.name);
    if (!picture) return Unexpected(picture.error());
    picture_ = std::move(*picture);
    return {};
  }

  SourceInfo info_;
  bool is_packed_ = false;
  bool has_stamps_ = false;
  Messages messages_;
  std::int64_t number_ = 0;  ///< of the next one
  MessageBytes bytes_;
  ros::Time recorded_;
  Message message_;  ///< in `bytes_`
  av::FramePtr picture_;
  av::Pictures pictures_;
  Frame frame_;
  std::int64_t damaged_ = 0;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_bag(const BagWord& word) {
  av::set_up();
  console_bridge::noOutputHandler();
  if (auto whole = check_bag(word.file, unpack_chunk); !whole) return Unexpected(whole.error());
  auto bag = std::make_unique<rosbag::Bag>();
  std::map<std::string, Topic> topics;
  try {
    bag->open(word.file);
    topics = topics_of(*bag);
  } catch (const std::exception& error) {
    return unreadable(std::string("is not a readable bag: ") + error.what(), word.file);
  }
  const auto name = topic_of(topics, word);
  if (!name) return Unexpected(name.error());
  const Topic& topic = topics.at(*name);
  const bool is_packed = topic.type == kPacked.name;
  if (topic.md5 != (is_packed ? kPacked : kRaw).md5) {
    return unreadable("topic " + *name + " has another definition of " + topic.type +
                          " than ROS 1; `rosbag check` says more",
                      word.file);
  }
  auto source = std::make_unique<BagFile>(word.file + (word.topic.empty() ? "" : ":" + word.topic),
                                          std::move(bag), *name, is_packed);
  if (const auto looked = source->look(); !looked) return Unexpected(looked.error());
  return source;
}

}  // namespace swarmsmith
