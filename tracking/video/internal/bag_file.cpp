#include "tracking/video/internal/bag_file.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracking/video/internal/av.h"
#include "tracking/video/internal/bag_index.h"
#include "tracking/video/internal/recorded_images.h"
#include "tracking/video/internal/ros_image.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

/// MD5 sums of the definitions of `sensor_msgs` that can be read.
constexpr std::string_view kImage = "060021388200f6f0f447d0fcd9c64743";
constexpr std::string_view kPackedImage = "8f7a12909da2c9d3332d540a0977563f";

/// Reads the messages of a topic in the order of recording. A damaged message has no bytes.
class BagMessages final : public MessageReader {
 public:
  BagMessages(std::int64_t size, bag::Read read, std::vector<bag::Entry> entries)
      : size_(size), read_(std::move(read)), entries_(std::move(entries)) {}

  Expected<std::optional<RecordedMessage>> next() override {
    if (next_ == entries_.size()) return std::optional<RecordedMessage>();
    const bag::Entry& entry = entries_[next_++];
    const std::string data = bytes_of(entry).value_or("");
    bytes_.assign(data.begin(), data.end());
    // Decoders and scalers read slightly beyond the end.
    bytes_.resize(data.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    return std::optional(RecordedMessage{entry.recorded_ns, bytes_.data(), data.size()});
  }
  void rewind() override { next_ = 0; }
  std::int64_t count() const override { return static_cast<std::int64_t>(entries_.size()); }

 private:
  std::optional<std::string> bytes_of(const bag::Entry& entry) {
    if (entry.chunk != chunk_) {
      chunk_ = entry.chunk;
      const auto found = bag::record_at(entry.chunk, size_, read_);
      records_ = found ? bag::unpacked(*found, read_) : std::nullopt;
    }
    if (!records_) return std::nullopt;
    const bag::Read inside = bag::reading_of(*records_);
    const auto size = static_cast<std::int64_t>(records_->size());
    auto record = bag::record_at(entry.place, size, inside);
    while (record && record->op == bag::Op::Connection)
      record = bag::record_at(record->end, size, inside);
    if (!record || record->op != bag::Op::Message ||
        bag::number_in<std::uint32_t>(record->fields, "conn") != entry.connection)
      return std::nullopt;
    return inside(record->data, record->size());
  }

  std::int64_t size_;
  bag::Read read_;
  std::vector<bag::Entry> entries_;
  std::size_t next_ = 0;
  std::int64_t chunk_ = -1;             ///< the chunk that is unpacked
  std::optional<std::string> records_;  ///< its records; nothing if unpacking failed
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_bag(const BagWord& word) {
  av::set_up();
  auto opened = av::ByteStream::reading(word.file);
  if (!opened) return Unexpected(opened.error());
  const auto bytes = std::make_shared<av::ByteStream>(std::move(*opened));
  const bag::Read read = bag::reading_of(bytes);
  auto index = bag::read_index(bytes->size(), read, word.file);
  if (!index) return Unexpected(index.error());
  std::map<std::string, std::string> types;
  for (const auto& [id, connection] : index->connections)
    types[connection.topic] = connection.type;
  const auto topic = image_topic(types, word);
  if (!topic) return Unexpected(topic.error());
  const bool is_packed = is_packed_type(types[*topic]);
  for (const auto& [id, connection] : index->connections) {
    if (connection.topic != *topic) continue;
    if (connection.type != types[*topic] || connection.md5 != (is_packed ? kPackedImage : kImage)) {
      return unreadable("topic " + *topic + " has another definition of " +
                            shortened(connection.type) + " than ROS 1; `rosbag check` says more",
                        word.file);
    }
  }
  std::erase_if(index->entries, [&](const bag::Entry& entry) {
    return index->connections[entry.connection].topic != *topic;
  });
  std::ranges::stable_sort(index->entries, {}, &bag::Entry::recorded_ns);
  return open_recorded(
      word.file + (word.topic.empty() ? "" : ":" + word.topic),
      std::make_unique<BagMessages>(bytes->size(), read, std::move(index->entries)),
      MessageForm::Ros1, is_packed);
}

}  // namespace swarmsmith
