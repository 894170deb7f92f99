#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tests/tracking/video/written_bag.h"

namespace swarmsmith {

/// A message as ROS 2 writes it (CDR, little-endian), or big-endian.
std::string cdr_of(const BagImage& image, bool is_big_endian = false);
std::string cdr_of(const BagPacked& image);
/// As ROS 1 does.
std::string ros1_of(const BagImage& image);

/// An MCAP file is made of these.
inline constexpr const char* kMcapMagic = "\x89MCAP0\r\n";
std::string little_endian(std::uint64_t value, std::size_t size);
std::string counted_text(const std::string& text);
std::string mcap_record(int opcode, const std::string& content);
/// `packing`: zstd or lz4; else as they are.
std::string packed_bytes(const std::string& packing, const std::string& bytes);

/// An MCAP file with a chunk for each so many messages; `packing`: none, zstd, lz4, or "bare" for
/// no chunks. Its bytes, as they are so far, can be taken at any time: a recorder that is killed.
class WrittenMcap {
 public:
  explicit WrittenMcap(std::string packing = "none", int messages_a_chunk = 4,
                       std::string encoding = "cdr");
  void add(const std::string& topic, const std::string& type, BagTime recorded,
           const std::string& message);
  std::string so_far() const { return bytes_; }
  std::string finished();

 private:
  void close_chunk();

  std::string packing_;
  int most_ = 0;
  std::string encoding_;
  std::string bytes_;
  std::string chunk_;
  int in_chunk_ = 0;
  std::map<std::string, int> channels_;
};

/// An SQLite file as rosbag2 writes one.
class WrittenDb3 {
 public:
  explicit WrittenDb3(const std::string& path);
  ~WrittenDb3();
  WrittenDb3(const WrittenDb3&) = delete;
  WrittenDb3& operator=(const WrittenDb3&) = delete;
  void add(const std::string& topic, const std::string& type, BagTime recorded,
           const std::string& message);
  /// SQL, with a blob for its `?`.
  void run(const std::string& text, const std::string* blob = nullptr);

 private:
  void* base_ = nullptr;
  std::map<std::string, int> topics_;
};

}  // namespace swarmsmith
