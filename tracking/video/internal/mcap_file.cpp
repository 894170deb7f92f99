#include "tracking/video/internal/mcap_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/byte_stream.h"
#include "tracking/video/internal/mcap_records.h"
#include "tracking/video/internal/recorded_images.h"
#include "tracking/video/internal/ros_image.h"

namespace swarmsmith {
namespace {

using mcap::Opcode;
using mcap::Record;

Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

struct Channel {
  std::string topic;
  std::string type;
  std::string encoding;  ///< of messages: "cdr", "ros1"
  std::int64_t messages = 0;
};

/// What a file has: its channels by number.
struct Contents {
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::string> schemas;

  void take(const Record& record) {
    mcap::Fields fields(record.content);
    if (record.opcode == Opcode::Schema) {
      const auto id = static_cast<std::uint16_t>(fields.number(2));
      schemas[id] = fields.text();
    } else if (record.opcode == Opcode::Channel) {
      const auto id = static_cast<std::uint16_t>(fields.number(2));
      Channel channel;
      channel.type = schemas[static_cast<std::uint16_t>(fields.number(2))];
      channel.topic = fields.text();
      channel.encoding = fields.text();
      // A channel is said again in the summary.
      channels.try_emplace(id, std::move(channel));
    } else if (record.opcode == Opcode::Message) {
      const auto found = channels.find(static_cast<std::uint16_t>(fields.number(2)));
      if (found != channels.end()) ++found->second.messages;
    }
  }
};

class McapMessages final : public MessageReader {
 public:
  McapMessages(av::ByteStream bytes, std::string name, std::vector<std::uint16_t> channels,
               std::int64_t count)
      : records_(std::move(bytes), name),
        name_(std::move(name)),
        channels_(std::move(channels)),
        count_(count) {}

  Expected<std::optional<RecordedMessage>> next() override {
    while (true) {
      auto record = records_.next();
      if (!record) return Unexpected(record.error());
      if (!*record) return std::optional<RecordedMessage>();
      if ((*record)->opcode != Opcode::Message) continue;
      mcap::Fields fields((*record)->content);
      const auto channel = static_cast<std::uint16_t>(fields.number(2));
      if (std::ranges::find(channels_, channel) == channels_.end()) continue;
      fields.number(4);  // counts messages
      const std::uint64_t time = fields.number(8);
      fields.number(8);  // when it was published
      const std::string_view data = fields.rest();
      if (fields.has_ended()) return unreadable("a message of it is too short", name_);
      bytes_.assign(data.begin(), data.end());
      // Decoders and scalers read a little beyond the end.
      bytes_.resize(data.size() + AV_INPUT_BUFFER_PADDING_SIZE);
      return std::optional(
          RecordedMessage{static_cast<std::int64_t>(std::min<std::uint64_t>(time, INT64_MAX)),
                          bytes_.data(), data.size()});
    }
  }
  void rewind() override { records_.rewind(); }
  std::int64_t count() const override { return count_; }

 private:
  mcap::Records records_;
  std::string name_;
  std::vector<std::uint16_t> channels_;
  std::int64_t count_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_mcap(const BagWord& word) {
  av::set_up();
  auto first = av::ByteStream::reading(word.file);
  if (!first) return Unexpected(first.error());
  mcap::Records records(std::move(*first), word.file);
  Contents contents;
  while (true) {
    const auto record = records.next();
    // What can be read up to there is read again, and then the damage is told with its place.
    if (!record && contents.channels.empty()) return Unexpected(record.error());
    if (!record || !*record) break;
    contents.take(**record);
  }
  std::map<std::string, std::string> types;
  for (const auto& [id, channel] : contents.channels) {
    if (channel.messages > 0) types[channel.topic] = channel.type;
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
    return unreadable("topic " + *topic + " has messages in the encoding `" + encoding +
                          "`, which is not read; cdr (ROS 2) and ros1 are",
                      word.file);
  }
  auto second = av::ByteStream::reading(word.file);
  if (!second) return Unexpected(second.error());
  return open_recorded(
      word.file + (word.topic.empty() ? "" : ":" + word.topic),
      std::make_unique<McapMessages>(std::move(*second), word.file, std::move(ids), count),
      encoding == "cdr" ? MessageForm::Cdr : MessageForm::Ros1, is_packed_type(types[*topic]));
}

}  // namespace swarmsmith
