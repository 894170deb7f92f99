#include "tracking/video/internal/bag_file.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>

#include <exception>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracking/video/internal/bag_check.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/ros_image.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

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

/// Throws when it ends too early. The definitions are those of `sensor_msgs`.
RosImage read_message(MessageBytes& from, bool is_packed) {
  RosImage message;
  ros::serialization::IStream in(from.bytes.data(), from.size);
  std::uint32_t number = 0;
  std::string text;
  std::uint8_t flag = 0;
  in.next(number);
  ros::Time stamp;
  in.next(stamp);
  message.stamp_s = stamp.sec;
  message.stamp_ns = stamp.nsec;
  message.is_packed = is_packed;
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
  std::uint32_t size = 0;
  in.next(size);
  message.size = size;
  message.data = in.advance(size);
  return message;
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
        has_stamps_ = ros_seconds(message_.stamp_s, message_.stamp_ns).has_value();
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
                .time_s = has_stamps_ ? ros_seconds(message_.stamp_s, message_.stamp_ns)
                                      : ros_seconds(recorded_.sec, recorded_.nsec),
                .gray = *gray};
      return true;
    }
    return false;
  }

 private:
  static constexpr const char* kNotRead = "its pixel format cannot be read";

  Expected<void> read_next() {
    try {
      recorded_ = messages_.take(bytes_);
      message_ = read_message(bytes_, is_packed_);
    } catch (const std::exception& error) {
      return unreadable(std::string("an image cannot be read: ") + error.what(), info_.name);
    }
    auto picture = picture_of(message_, info_.name);
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
  RosImage message_;  ///< in `bytes_`
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
  std::map<std::string, std::string> types;
  for (const auto& [topic, about] : topics)
    types[topic] = about.type;
  const auto name = image_topic(types, word);
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
