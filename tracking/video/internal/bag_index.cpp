#include "tracking/video/internal/bag_index.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

#include "tracking/video/internal/unreadable.h"

namespace swarmsmith::bag {
namespace {

class Reading {
 public:
  Reading(std::int64_t size, const Read& read, std::string name)
      : size_(size), read_(read), name_(std::move(name)) {}

  Expected<Index> run() {
    const auto version = read_(0, static_cast<std::int64_t>(kVersion.size()));
    if (!version || *version != kVersion) {
      return unreadable(
          "is not a bag of ROS 1 in format 2.0: it does not begin with `#ROSBAG V2.0`", name_);
    }
    const auto head = record_at(kVersion.size(), size_, read_);
    const auto index = head && head->op == Op::File
                           ? number_in<std::uint64_t>(head->fields, "index_pos")
                           : std::nullopt;
    if (!index) return damaged(kVersion.size());
    if (*index == 0) {
      return unreadable(
          "has no index, because its recording was not ended; `rosbag reindex` makes one", name_);
    }
    if (!text_in(head->fields, "encryptor").empty()) {
      return unreadable("is encrypted; `rosbag decrypt` makes one that can be read", name_);
    }
    bool leads_to_a_record = false;
    std::int64_t at = head->end;
    while (at < size_) {
      leads_to_a_record = leads_to_a_record || static_cast<std::uint64_t>(at) == *index;
      const auto found = record_at(at, size_, read_);
      if (!found || !take(at, *found)) return damaged(at);
      at = found->end;
    }
    // In an empty bag the index is at the end of the file.
    leads_to_a_record = leads_to_a_record || static_cast<std::uint64_t>(at) == *index;
    const bool is_counted =
        number_in<std::uint32_t>(head->fields, "chunk_count") == chunks_.size() &&
        number_in<std::uint32_t>(head->fields, "conn_count") == index_.connections.size();
    if (!leads_to_a_record || !is_counted) return damaged(kVersion.size());
    for (const std::uint32_t connection : indexed_) {
      if (!index_.connections.contains(connection)) return damaged(kVersion.size());
    }
    std::erase_if(index_.connections,
                  [&](const auto& one) { return !indexed_.contains(one.first); });
    return std::move(index_);
  }

 private:
  Unexpected damaged(std::int64_t at) const {
    return unreadable(
        fmt::format(
            "is damaged or cut off at byte {} of {}; copy it again, or try `rosbag reindex`", at,
            size_),
        name_);
  }

  /// Takes a record; returns whether it is valid after the records before it.
  bool take(std::int64_t at, const Record& found) {
    switch (found.op) {
      case Op::Chunk:
        chunks_.insert(at);
        return take_chunk(found);
      case Op::Index:
        return take_index(found);
      case Op::Connection:
        return take_connection(found);
      case Op::ChunkInfo: {
        const auto place = number_in<std::uint64_t>(found.fields, "chunk_pos");
        const auto count = number_in<std::uint32_t>(found.fields, "count");
        return place && chunks_.contains(static_cast<std::int64_t>(*place)) && count &&
               found.size() == 8 * std::int64_t{*count};
      }
      case Op::Message:
      case Op::File:
        break;
    }
    return false;
  }

  bool take_chunk(const Record& chunk) {
    const auto size = number_in<std::uint32_t>(chunk.fields, "size");
    const auto packing = chunk.fields.find("compression");
    if (!size || packing == chunk.fields.end() || *size > kMostChunk || chunk.size() > kMostChunk) {
      return false;
    }
    return packing->second != "none" || chunk.size() == *size;
  }

  /// Reads an index of the previous chunk: a time (8 bytes) and the position of each message.
  bool take_index(const Record& index) {
    constexpr std::size_t kEntry = 12;
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    const auto connection = number_in<std::uint32_t>(index.fields, "conn");
    const auto count = number_in<std::uint32_t>(index.fields, "count");
    if (chunks_.empty() || !connection || !count || index.size() != std::int64_t{kEntry} * *count)
      return false;
    const auto entries = read_(index.data, index.size());
    if (!entries) return false;
    indexed_.insert(*connection);
    for (std::size_t at = 0; at < entries->size(); at += kEntry) {
      const auto seconds = number_at<std::uint32_t>(*entries, at).value();
      const auto nanoseconds = number_at<std::uint32_t>(*entries, at + 4).value();
      const auto place = number_at<std::uint32_t>(*entries, at + 8).value();
      index_.entries.push_back({.recorded_ns = seconds * kNanoseconds + nanoseconds,
                                .chunk = *chunks_.rbegin(),
                                .place = place,
                                .connection = *connection});
    }
    return true;
  }

  bool take_connection(const Record& connection) {
    const auto id = number_in<std::uint32_t>(connection.fields, "conn");
    if (!id || connection.size() > kMostHeader) return false;
    const auto bytes = read_(connection.data, connection.size());
    const auto about = bytes ? fields_of(*bytes) : std::nullopt;
    if (!about) return false;
    index_.connections[*id] = {.topic = text_in(connection.fields, "topic"),
                               .type = text_in(*about, "type"),
                               .md5 = text_in(*about, "md5sum")};
    return true;
  }

  std::int64_t size_;
  const Read& read_;
  std::string name_;
  Index index_;
  std::set<std::int64_t> chunks_;    ///< where the chunks begin
  std::set<std::uint32_t> indexed_;  ///< connections with messages
};

}  // namespace

Read reading_of(std::shared_ptr<av::ByteStream> bytes) {
  return [bytes = std::move(bytes)](std::int64_t at,
                                    std::int64_t count) -> std::optional<std::string> {
    if (at < 0 || count < 0 || at > bytes->size() || count > bytes->size() - at)
      return std::nullopt;
    std::string text(static_cast<std::size_t>(count), '\0');
    if (avio_seek(bytes->io(), at, SEEK_SET) < 0) return std::nullopt;
    const auto size = static_cast<int>(count);
    if (avio_read(bytes->io(), reinterpret_cast<unsigned char*>(text.data()), size) != size) {
      return std::nullopt;
    }
    return text;
  };
}

Expected<Index> read_index(std::int64_t size, const Read& read, const std::string& name) {
  return Reading(size, read, name).run();
}

}  // namespace swarmsmith::bag
