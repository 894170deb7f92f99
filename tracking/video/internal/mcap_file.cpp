#include "tracking/video/internal/mcap_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracking/video/internal/byte_stream.h"
#include "tracking/video/internal/mcap_records.h"
#include "tracking/video/internal/recorded_images.h"
#include "tracking/video/internal/ros_image.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

using mcap::Opcode;
using mcap::Record;

struct Channel {
  std::string topic;
  std::string type;
  std::string encoding;  ///< encoding of the messages: "cdr", "ros1"
  std::int64_t messages = 0;
};

/// The limit for topics in ROS 2 (DDS).
constexpr std::size_t kLongestName = 255;

/// The contents of a file: its channels and schemas by id.
struct Contents {
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::string> schemas;

  /// False for an invalid record.
  bool take(const Record& record) {
    mcap::Fields fields(record.content);
    if (record.opcode == Opcode::Schema) {
      const auto id = static_cast<std::uint16_t>(fields.number(2));
      std::string& name = schemas[id];
      name = fields.text();
      return !fields.has_ended() && name.size() <= kLongestName;
    } else if (record.opcode == Opcode::Channel) {
      const auto id = static_cast<std::uint16_t>(fields.number(2));
      Channel channel;
      channel.type = schemas[static_cast<std::uint16_t>(fields.number(2))];
      channel.topic = fields.text();
      channel.encoding = fields.text();
      if (fields.has_ended() || channel.topic.size() > kLongestName ||
          channel.encoding.size() > kLongestName)
        return false;
      // The summary repeats the channels.
      channels.try_emplace(id, std::move(channel));
    } else if (record.opcode == Opcode::Message) {
      const auto found = channels.find(static_cast<std::uint16_t>(fields.number(2)));
      if (found != channels.end()) ++found->second.messages;
      return !fields.has_ended();
    }
    return true;
  }
};

class McapMessages final : public MessageReader {
 public:
  McapMessages(av::ByteStream bytes, std::string name, std::vector<std::uint16_t> channels,
               std::int64_t count, bool is_cut)
      : records_(std::move(bytes), name),
        name_(std::move(name)),
        channels_(std::move(channels)),
        count_(count),
        is_cut_(is_cut) {}

  Expected<std::optional<RecordedMessage>> next() override {
    while (true) {
      auto record = records_.next();
      if (!record) return Unexpected(record.error());
      if (!*record) return std::optional<RecordedMessage>();
      if ((*record)->opcode != Opcode::Message) continue;
      mcap::Fields fields((*record)->content);
      const auto channel = static_cast<std::uint16_t>(fields.number(2));
      if (std::ranges::find(channels_, channel) == channels_.end()) continue;
      fields.number(4);  // sequence number of the message
      const std::uint64_t time = fields.number(8);
      fields.number(8);  // time of publication
      const std::string_view data = fields.rest();
      if (fields.has_ended()) return records_.damaged("a message that is too short");
      bytes_.assign(data.begin(), data.end());
      // Decoders and scalers read slightly beyond the end.
      bytes_.resize(data.size() + AV_INPUT_BUFFER_PADDING_SIZE);
      return std::optional(
          RecordedMessage{static_cast<std::int64_t>(std::min<std::uint64_t>(time, INT64_MAX)),
                          bytes_.data(), data.size()});
    }
  }
  void rewind() override { records_.rewind(); }
  std::int64_t count() const override { return count_; }
  bool is_cut() const override { return is_cut_; }

 private:
  mcap::Records records_;
  std::string name_;
  std::vector<std::uint16_t> channels_;
  std::int64_t count_;
  bool is_cut_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_mcap(const BagWord& word) {
  av::set_up();
  auto first = av::ByteStream::reading(word.file);
  if (!first) return Unexpected(first.error());
  mcap::Records records(std::move(*first), word.file);
  Contents contents;
  std::optional<Error> damage;
  while (!damage) {
    const auto record = records.next();
    if (!record) damage = record.error();
    if (!record || !*record) break;
    if (!contents.take(**record))
      damage =
          records.damaged("a record before this place is too short, or its names too long").value();
  }
  std::map<std::string, std::string> types;
  for (const auto& [id, channel] : contents.channels) {
    if (channel.messages > 0) types[channel.topic] = channel.type;
  }
  // The readable part is read again later, and then the damage is reported with its position.
  if (damage &&
      std::ranges::none_of(types, has_ros_images, [](const auto& topic) { return topic.second; }))
    return Unexpected(*damage);
  if (types.empty() && records.is_cut()) {
    return unreadable(
        "ends before its first message: the recording was not ended properly, or the "
        "file is incomplete; copy it again",
        word.file);
  }
  const auto topic = image_topic(types, word);
  if (!topic) return Unexpected(topic.error());
  std::vector<std::uint16_t> ids;
  std::int64_t count = 0;
  std::string encoding;
  for (const auto& [id, channel] : contents.channels) {
    if (channel.topic != *topic || channel.messages == 0) continue;
    if (!has_ros_images(channel.type) || (!encoding.empty() && channel.encoding != encoding)) {
      return unreadable("topic " + *topic + " has messages of several kinds", word.file);
    }
    encoding = channel.encoding;
    ids.push_back(id);
    count += channel.messages;
  }
  if (encoding != "cdr" && encoding != "ros1") {
    return unreadable("topic " + *topic + " has messages in the encoding `" + shortened(encoding) +
                          "`, which is not supported; cdr (ROS 2) and ros1 are",
                      word.file);
  }
  auto second = av::ByteStream::reading(word.file);
  if (!second) return Unexpected(second.error());
  return open_recorded(word.file + (word.topic.empty() ? "" : ":" + word.topic),
                       std::make_unique<McapMessages>(std::move(*second), word.file, std::move(ids),
                                                      count, records.is_cut()),
                       encoding == "cdr" ? MessageForm::Cdr : MessageForm::Ros1,
                       is_packed_type(types[*topic]));
}

}  // namespace swarmsmith
