#include "tracking/video/internal/bag_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::uint32_t kMostHeader = 1'000'000;  // as the library has it
constexpr std::uint32_t kMostChunk = 400U << 20;

enum class Op : std::uint8_t {
  Message = 2,
  File = 3,
  Index = 4,
  Chunk = 5,
  ChunkInfo = 6,
  Connection = 7,
};

using Fields = std::map<std::string, std::string, std::less<>>;

/// The bits of a number, which lie as this machine has them; nothing where there are too few.
template <class Number>
std::optional<Number> number_at(std::string_view bytes, std::size_t at) {
  Number number{};
  if (at > bytes.size() || bytes.size() - at < sizeof number) return std::nullopt;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

template <class Number>
std::optional<Number> number_in(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(Number)) return std::nullopt;
  return number_at<Number>(found->second, 0);
}

/// `length name=value`, again and again.
std::optional<Fields> fields_of(std::string_view bytes) {
  Fields fields;
  while (!bytes.empty()) {
    const auto length = number_at<std::uint32_t>(bytes, 0);
    if (!length || *length > kMostHeader || *length > bytes.size() - sizeof *length) {
      return std::nullopt;
    }
    const std::string_view field = bytes.substr(sizeof *length, *length);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    bytes.remove_prefix(sizeof *length + *length);
  }
  return fields;
}

/// So many bytes from a place on; nothing beyond the end.
using Read = std::function<std::optional<std::string>(std::int64_t at, std::int64_t count)>;

struct Record {
  Op op{};
  Fields fields;
  std::int64_t data = 0;  ///< where it begins
  std::int64_t end = 0;

  std::int64_t size() const { return end - data; }
};

/// The record that begins there and ends before `limit`.
std::optional<Record> record_at(std::int64_t at, std::int64_t limit, const Read& read) {
  constexpr std::int64_t kLength = sizeof(std::uint32_t);
  const auto length_at = [&](std::int64_t place) -> std::optional<std::uint32_t> {
    const auto bytes = read(place, kLength);
    return bytes ? number_at<std::uint32_t>(*bytes, 0) : std::nullopt;
  };
  const auto header_size = length_at(at);
  if (!header_size || *header_size > kMostHeader) return std::nullopt;
  const auto header = read(at + kLength, *header_size);
  auto fields = header ? fields_of(*header) : std::nullopt;
  const auto op = fields ? number_in<std::uint8_t>(*fields, "op") : std::nullopt;
  const auto data_size = length_at(at + kLength + *header_size);
  if (!op || !data_size) return std::nullopt;
  const std::int64_t data = at + kLength + *header_size + kLength;
  if (data + *data_size > limit) return std::nullopt;
  return Record{static_cast<Op>(*op), std::move(*fields), data, data + *data_size};
}

/// The places in a chunk that an index may name; nothing when it does not consist of records. The
/// library goes from a connection on to the next message.
std::optional<std::vector<std::uint32_t>> messages_in(std::int64_t size, const Read& read) {
  std::vector<std::uint32_t> messages;
  std::vector<std::uint32_t> before;
  for (std::int64_t at = 0; at < size;) {
    const auto found = record_at(at, size, read);
    if (!found) return std::nullopt;
    before.push_back(static_cast<std::uint32_t>(at));
    if (found->op == Op::Message) {
      messages.insert(messages.end(), before.begin(), before.end());
      before.clear();
    } else if (found->op != Op::Connection) {
      return std::nullopt;
    }
    at = found->end;
  }
  return messages;
}

class Check {
 public:
  Check(av::ByteStream bytes, std::string name, const UnpackChunk& unpack)
      : bytes_(std::move(bytes)), name_(std::move(name)), unpack_(unpack) {}

  Expected<void> run() {
    const auto version = read(0, static_cast<std::int64_t>(kVersion.size()));
    if (!version || *version != kVersion) {
      return unreadable(
          "is not a bag of ROS 1 in format 2.0: it does not begin with `#ROSBAG V2.0`");
    }
    const auto head = record(kVersion.size());
    const auto index = head && head->op == Op::File
                           ? number_in<std::uint64_t>(head->fields, "index_pos")
                           : std::nullopt;
    if (!index) return damaged(kVersion.size());
    if (*index == 0) {
      return unreadable("has no index: its recording was not ended; `rosbag reindex` makes one");
    }
    if (const auto encryptor = head->fields.find("encryptor");
        encryptor != head->fields.end() && !encryptor->second.empty()) {
      return unreadable("is encrypted; `rosbag decrypt` makes one that can be read");
    }
    bool leads_to_a_record = false;
    std::int64_t at = head->end;
    while (at < bytes_.size()) {
      leads_to_a_record = leads_to_a_record || static_cast<std::uint64_t>(at) == *index;
      const auto found = record(at);
      if (!found || !take(at, *found)) return damaged(at);
      at = found->end;
    }
    // That of an empty bag leads to its end.
    leads_to_a_record = leads_to_a_record || static_cast<std::uint64_t>(at) == *index;
    const bool is_counted =
        number_in<std::uint32_t>(head->fields, "chunk_count") == chunks_.size() &&
        number_in<std::uint32_t>(head->fields, "conn_count") == connections_.size();
    const bool is_known = std::ranges::includes(connections_, indexed_);
    if (!leads_to_a_record || !is_counted || !is_known) return damaged(kVersion.size());
    return {};
  }

 private:
  Unexpected unreadable(const std::string& text) const {
    return Unexpected(error_of(IssueCode::VideoUnreadable, text, name_));
  }

  Unexpected damaged(std::int64_t at) const {
    return unreadable(fmt::format(
        "is damaged or cut off at byte {} of {}; copy it again, or try `rosbag reindex`", at,
        bytes_.size()));
  }

  std::optional<Record> record(std::int64_t at) {
    return record_at(at, bytes_.size(),
                     [this](std::int64_t place, std::int64_t count) { return read(place, count); });
  }

  std::optional<std::string> read(std::int64_t at, std::int64_t count) {
    if (at < 0 || count < 0 || count > bytes_.size() - at) return std::nullopt;
    std::string text(static_cast<std::size_t>(count), '\0');
    if (avio_seek(bytes_.io(), at, SEEK_SET) < 0) return std::nullopt;
    const auto size = static_cast<int>(count);
    if (avio_read(bytes_.io(), reinterpret_cast<unsigned char*>(text.data()), size) != size) {
      return std::nullopt;
    }
    return text;
  }

  /// Whether a record is right beside those before it.
  bool take(std::int64_t at, const Record& found) {
    switch (found.op) {
      case Op::Chunk:
        chunks_.insert(static_cast<std::uint64_t>(at));
        return take_chunk(found);
      case Op::Index:
        return take_index(found);
      case Op::Connection:
        return take_connection(found);
      case Op::ChunkInfo: {
        const auto place = number_in<std::uint64_t>(found.fields, "chunk_pos");
        const auto count = number_in<std::uint32_t>(found.fields, "count");
        return place && chunks_.contains(*place) && count &&
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
    Read inside = [&](std::int64_t at, std::int64_t count) { return read(chunk.data + at, count); };
    std::string unpacked;
    is_lost_ = false;
    if (packing->second != "none") {
      auto packed = read(chunk.data, chunk.size());
      unpacked.resize(*size);
      is_lost_ = !packed || !unpack_(packing->second, *packed, unpacked);
      if (is_lost_) return true;
      inside = [&](std::int64_t at, std::int64_t count) -> std::optional<std::string> {
        if (at > *size || count > *size - at) return std::nullopt;
        return unpacked.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(count));
      };
    } else if (chunk.size() != *size) {
      return false;
    }
    auto messages = messages_in(*size, inside);
    if (!messages) return false;
    messages_ = std::move(*messages);
    return true;
  }

  /// Of the chunk before it: a time (8 bytes) and the place of each message.
  bool take_index(const Record& index) {
    constexpr std::size_t kEntry = 12;
    const auto connection = number_in<std::uint32_t>(index.fields, "conn");
    const auto count = number_in<std::uint32_t>(index.fields, "count");
    if (!connection || !count || index.size() != std::int64_t{kEntry} * *count) return false;
    const auto entries = read(index.data, index.size());
    if (!entries) return false;
    indexed_.insert(*connection);
    for (std::size_t at = 8; at < entries->size(); at += kEntry) {
      const std::uint32_t place = number_at<std::uint32_t>(*entries, at).value();
      if (!is_lost_ && !std::ranges::binary_search(messages_, place)) return false;
    }
    return true;
  }

  bool take_connection(const Record& connection) {
    const auto id = number_in<std::uint32_t>(connection.fields, "conn");
    if (!id || connection.size() > kMostHeader) return false;
    connections_.insert(*id);
    const auto about = read(connection.data, connection.size());
    return about && fields_of(*about);
  }

  av::ByteStream bytes_;
  std::string name_;
  std::set<std::uint64_t> chunks_;  ///< where they begin
  std::set<std::uint32_t> connections_;
  std::set<std::uint32_t> indexed_;  ///< connections that have messages
  const UnpackChunk& unpack_;
  // Of the last chunk.
  bool is_lost_ = false;                 ///< it cannot be unpacked
  std::vector<std::uint32_t> messages_;  ///< places that the index may name
};

}  // namespace

Expected<void> check_bag(const std::string& file, const UnpackChunk& unpack) {
  auto bytes = av::ByteStream::reading(file);
  if (!bytes) return Unexpected(bytes.error());
  return Check(std::move(*bytes), file, unpack).run();
}

}  // namespace swarmsmith
