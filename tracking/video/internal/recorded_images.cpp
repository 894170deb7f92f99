#include "tracking/video/internal/recorded_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/ros_image.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

/// Reads fields from the front of a message: CDR (Common Data Representation, OMG DDS-XTypes 7.4,
/// version 1), as in ROS 2, or the form of ROS 1, which has no alignment. After the end, all values
/// are 0.
class Fields {
 public:
  Fields(std::uint8_t* bytes, std::size_t size, MessageForm form)
      : bytes_(bytes), size_(size), is_cdr_(form == MessageForm::Cdr) {
    if (!is_cdr_) return;
    constexpr std::size_t kHead = 4;
    is_other_ = size >= kHead && (bytes[0] != 0 || bytes[1] > 1);
    has_ended_ = size < kHead || is_other_;
    if (has_ended_) return;
    is_big_endian_ = bytes[1] == 0;
    bytes_ += kHead;
    size_ -= kHead;
  }

  std::uint32_t number() {
    constexpr std::size_t kSize = 4;
    if (is_cdr_) at_ += (kSize - at_ % kSize) % kSize;
    const std::uint8_t* const from = take(kSize);
    if (from == nullptr) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < kSize; ++i)
      value = value << 8U | from[is_big_endian_ ? i : kSize - 1 - i];
    return value;
  }
  std::uint8_t byte() {
    const std::uint8_t* const from = take(1);
    return from == nullptr ? std::uint8_t{0} : *from;
  }
  /// In CDR the length of a text includes the zero at the end.
  std::string text() {
    const std::uint32_t length = number();
    const std::uint8_t* const from = take(length);
    if (from == nullptr) return {};
    const std::string all(reinterpret_cast<const char*>(from), length);
    return all.substr(0, all.find('\0'));
  }
  std::uint8_t* take(std::size_t count) {
    if (has_ended_ || at_ > size_ || count > size_ - at_) {
      has_ended_ = true;
      return nullptr;
    }
    std::uint8_t* const from = bytes_ + at_;
    at_ += count;
    return from;
  }
  bool has_ended() const { return has_ended_; }
  bool is_other() const { return is_other_; }

 private:
  std::uint8_t* bytes_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool is_cdr_;
  bool is_big_endian_ = false;
  bool has_ended_ = false;
  bool is_other_ = false;  ///< it does not begin like a message of this form
};

/// The error for bytes that do not begin as the form requires.
std::string other_form(const std::uint8_t* begin) {
  const std::array<std::uint8_t, 4> zstd{0x28, 0xb5, 0x2f, 0xfd};
  if (std::equal(zstd.begin(), zstd.end(), begin)) {
    return "its messages are packed one by one with zstd; `ros2 bag convert` makes a bag without, "
           "or "
           "record with `--compression-mode file`";
  }
  return fmt::format("a message begins with the bytes {:02x} {:02x}, which is not CDR of version 1",
                     begin[0], begin[1]);
}

/// Reads an image as defined by `sensor_msgs`. The error gives the reason why it cannot be read.
tl::expected<RosImage, std::string> image_of(const RecordedMessage& message, MessageForm form,
                                             bool is_packed) {
  Fields fields(message.bytes, message.size, form);
  RosImage image;
  image.is_packed = is_packed;
  if (form == MessageForm::Ros1) fields.number();  // sequence number
  image.stamp_s = fields.number();
  image.stamp_ns = fields.number();
  fields.text();  // coordinate frame
  if (is_packed) {
    fields.text();  // format, which the first bytes show more reliably
  } else {
    image.height = fields.number();
    image.width = fields.number();
    image.encoding = fields.text();
    image.is_big_endian = fields.byte() != 0;
    image.step = fields.number();
  }
  image.size = fields.number();
  image.data = fields.take(image.size);
  if (fields.is_other()) return tl::unexpected(other_form(message.bytes));
  if (fields.has_ended())
    return tl::unexpected(std::string("an image cannot be read: it ends too early"));
  return image;
}

class RecordedImages final : public FrameSource {
 public:
  RecordedImages(std::string name, std::unique_ptr<MessageReader> messages, MessageForm form,
                 bool is_packed)
      : messages_(std::move(messages)), form_(form), is_packed_(is_packed) {
    info_.name = std::move(name);
    info_.expected_frames = messages_->count();
    info_.has_times = true;
    // This is not an issue of the run: a recorder that is killed writes no end, and runs that the
    // film does not cover are refused anyway.
    if (messages_->is_cut()) {
      info_.oddities.emplace_back(
          "it was cut off: the recording was not ended properly, or the file is incomplete, and "
          "what came last is missing");
    }
  }

  /// Reads the first readable image to find the size of the images, and whether they have time
  /// stamps.
  Expected<void> look() {
    std::optional<Error> first_error;
    while (true) {
      auto message = messages_->next();
      if (!message) return Unexpected(message.error());
      if (!*message) break;
      if (const auto read = decode(**message); !read) {
        if (!first_error) first_error = read.error();
        continue;
      }
      info_.size = {picture_->width, picture_->height};
      if (!pictures_.gray(*picture_)) return unreadable(kNotRead, info_.name);
      has_stamps_ = ros_seconds(image_.stamp_s, image_.stamp_ns).has_value();
      messages_->rewind();
      return {};
    }
    if (first_error) return Unexpected(*first_error);
    return unreadable("the topic has no images", info_.name);
  }

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return pictures_.color(*picture_); }
  std::int64_t damaged_frames() const override { return damaged_; }

  Expected<bool> next() override {
    while (true) {
      auto message = messages_->next();
      if (!message) return Unexpected(message.error());
      if (!*message) return false;
      const std::int64_t number = number_++;
      if (!decode(**message)) {
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
      frame_ = {.number = number, .time_s = time_of(**message), .gray = *gray, .file = {}};
      return true;
    }
  }

 private:
  static constexpr const char* kNotRead = "its pixel format cannot be read";

  std::optional<double> time_of(const RecordedMessage& message) const {
    if (has_stamps_) return ros_seconds(image_.stamp_s, image_.stamp_ns);
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    const std::int64_t seconds = message.recorded_ns / kNanoseconds;
    if (message.recorded_ns <= 0 || seconds > UINT32_MAX) return std::nullopt;
    return ros_seconds(static_cast<std::uint32_t>(seconds),
                       static_cast<std::uint32_t>(message.recorded_ns % kNanoseconds));
  }

  Expected<void> decode(const RecordedMessage& message) {
    auto image = image_of(message, form_, is_packed_);
    if (!image) return unreadable(image.error(), info_.name);
    image_ = std::move(*image);
    auto picture = picture_of(image_, info_.name);
    if (!picture) return Unexpected(picture.error());
    picture_ = std::move(*picture);
    return {};
  }

  SourceInfo info_;
  std::unique_ptr<MessageReader> messages_;
  MessageForm form_;
  bool is_packed_;
  bool has_stamps_ = false;
  std::int64_t number_ = 0;  ///< number of the next image
  RosImage image_;           ///< points into the reader's bytes
  av::FramePtr picture_;
  av::Pictures pictures_;
  Frame frame_;
  std::int64_t damaged_ = 0;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_recorded(std::string name,
                                                     std::unique_ptr<MessageReader> messages,
                                                     MessageForm form, bool is_packed) {
  auto source =
      std::make_unique<RecordedImages>(std::move(name), std::move(messages), form, is_packed);
  if (const auto looked = source->look(); !looked) return Unexpected(looked.error());
  return source;
}

}  // namespace swarmsmith
