#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

/// Records of a bag of ROS 1: http://wiki.ros.org/Bags/Format/2.0.
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

/// A text; empty where there is none.
std::string text_in(const Fields& fields, std::string_view name);

/// `length name=value`, again and again; nothing for bytes that are none.
std::optional<Fields> fields_of(std::string_view bytes);

/// So many bytes from a place on; nothing beyond the end.
using Read = std::function<std::optional<std::string>(std::int64_t at, std::int64_t count)>;
Read reading_of(const std::string& bytes);

struct Record {
  Op op{};
  Fields fields;
  std::int64_t data = 0;  ///< where it begins
  std::int64_t end = 0;

  std::int64_t size() const { return end - data; }
};

/// The record that begins there and ends before `limit`.
std::optional<Record> record_at(std::int64_t at, std::int64_t limit, const Read& read);

/// The records of a chunk (`none`, `bz2`, `lz4`), whose header says how large they are. Nothing
/// when it is damaged, or packed in another way.
std::optional<std::string> unpacked(const Record& chunk, const Read& read);

}  // namespace swarmsmith::bag
