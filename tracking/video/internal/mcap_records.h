#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith::mcap {

/// Those that are read; others are passed over.
enum class Opcode : std::uint8_t { Schema = 3, Channel = 4, Message = 5, Chunk = 6, DataEnd = 15 };

struct Record {
  Opcode opcode{};
  std::string_view content;  ///< lives until the next record is asked for
};

/// Takes little-endian fields off the front of a record. Once it has ended, all is 0.
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

/// The records of a file's data section, those in chunks among them, from front to back. No length
/// that a file names is believed beyond its own bytes, or 512 MB at a time, and none that a few
/// packed bytes cannot have.
class Records {
 public:
  Records(av::ByteStream bytes, std::string name);

  /// Nothing at the end, of a file that was cut off between two records, too. E_VIDEO_UNREADABLE
  /// with the place where it is damaged.
  Expected<std::optional<Record>> next();
  void rewind();
  /// Once the end was reached: it ended before the file said that it does.
  bool is_cut() const { return is_cut_; }
  /// An error with the place of the next record, or of the one after the last that was read.
  Unexpected damaged(const std::string& what) const;

 private:
  Expected<std::optional<Record>> next_outside();
  Expected<void> unpack(const Record& chunk);

  av::ByteStream bytes_;
  std::string name_;
  std::int64_t at_ = 0;      ///< the next record outside of chunks
  std::string record_;       ///< the last of those
  std::string unpacked_;     ///< the chunk's records, where they were packed
  std::string_view inside_;  ///< the rest of the chunk
  bool is_over_ = false;
  bool is_cut_ = false;
};

}  // namespace swarmsmith::mcap
