#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

/// Records of a ROS 1 bag: http://wiki.ros.org/Bags/Format/2.0.
namespace swarmsmith::bag {

inline constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
inline constexpr std::uint32_t kMostHeader = 1'000'000;
inline constexpr std::uint32_t kMostChunk = 400U << 20;

enum class Op : std::uint8_t {
  Message = 2,
  File = 3,
  Index = 4,
  Chunk = 5,
  ChunkInfo = 6,
  Connection = 7,
};

using Fields = std::map<std::string, std::string, std::less<>>;

/// Reads a number in the byte order of this machine; nothing if there are too few bytes.
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

/// A text field; empty if it is missing.
std::string text_in(const Fields& fields, std::string_view name);

/// Parses a sequence of `length name=value`; nothing if the bytes have another form.
std::optional<Fields> fields_of(std::string_view bytes);

/// Reads `count` bytes from a position; nothing beyond the end.
using Read = std::function<std::optional<std::string>(std::int64_t at, std::int64_t count)>;
Read reading_of(const std::string& bytes);

struct Record {
  Op op{};
  Fields fields;
  std::int64_t data = 0;  ///< where its data begin
  std::int64_t end = 0;

  std::int64_t size() const { return end - data; }
};

/// The record that begins at a position and ends before `limit`.
std::optional<Record> record_at(std::int64_t at, std::int64_t limit, const Read& read);

/// The records of a chunk (`none`, `bz2`, `lz4`), whose header gives their size. Nothing if the
/// chunk is damaged or uses another compression.
std::optional<std::string> unpacked(const Record& chunk, const Read& read);

}  // namespace swarmsmith::bag
