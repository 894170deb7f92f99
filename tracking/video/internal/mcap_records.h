#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith::mcap {

/// The records that are read; others are skipped.
enum class Opcode : std::uint8_t { Schema = 3, Channel = 4, Message = 5, Chunk = 6, DataEnd = 15 };

struct Record {
  Opcode opcode{};
  std::string_view content;  ///< valid until the next record is read
};

/// Reads little-endian fields from the front of a record. After the end, all values are 0.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number(std::size_t size);
  std::string_view bytes(std::uint64_t size);
  std::string text() { return std::string(bytes(number(4))); }
  std::string_view rest() const { return rest_; }
  bool has_ended() const { return has_ended_; }

 private:
  std::string_view rest_;
  bool has_ended_ = false;
};

/// The records of a file's data section, including the records in chunks, from front to back. A
/// length in the file is not trusted if it exceeds the rest of the file or 512 MB, or if the
/// compressed bytes are too few to expand to it.
class Records {
 public:
  Records(av::ByteStream bytes, std::string name);

  /// Nothing at the end, even if the file was truncated between two records. E_VIDEO_UNREADABLE,
  /// with the position of the damage.
  Expected<std::optional<Record>> next();
  void rewind();
  /// After the end was reached: the file was truncated.
  bool is_cut() const { return is_cut_; }
  /// An error with the position of the next record outside of chunks.
  Unexpected damaged(const std::string& what) const;

 private:
  Expected<std::optional<Record>> next_outside();
  Expected<void> unpack(const Record& chunk);

  av::ByteStream bytes_;
  std::string name_;
  std::int64_t at_ = 0;      ///< position of the next record outside of chunks
  std::string record_;       ///< the last record outside of chunks
  std::string unpacked_;     ///< the chunk's records, if they were compressed
  std::string_view inside_;  ///< unread rest of the chunk
  bool is_over_ = false;
  bool is_cut_ = false;
};

}  // namespace swarmsmith::mcap
