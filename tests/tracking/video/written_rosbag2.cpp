#include "tests/tracking/video/written_rosbag2.h"

#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <stdexcept>
#include <utility>

namespace swarmsmith {
std::string little_endian(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (; bytes.size() < size; value >>= 8)
    bytes += static_cast<char>(value & 0xFF);
  return bytes;
}

std::string counted_text(const std::string& text) {
  return little_endian(text.size(), 4) + text;
}

std::string mcap_record(int opcode, const std::string& content) {
  return std::string(1, static_cast<char>(opcode)) + little_endian(content.size(), 8) + content;
}

namespace {

/// Fields of a message, one after the other.
struct Message {
  std::string bytes;
  bool is_cdr = true;
  bool is_big_endian = false;

  void number(std::uint64_t value) {
    while (is_cdr && bytes.size() % 4 != 0)
      bytes += '\0';
    std::string four = little_endian(value, 4);
    if (is_big_endian) four = std::string(four.rbegin(), four.rend());
    bytes += four;
  }
  void text(const std::string& value) {
    number(value.size() + (is_cdr ? 1 : 0));
    bytes += value;
    if (is_cdr) bytes += '\0';
  }
  void data(const std::vector<std::uint8_t>& value) {
    number(value.size());
    bytes.append(value.begin(), value.end());
  }
  void stamp(BagTime time) {
    number(static_cast<std::uint64_t>(time / 1'000'000'000));
    number(static_cast<std::uint64_t>(time % 1'000'000'000));
  }
  void image(const BagImage& image) {
    stamp(image.stamp);
    text("ceiling");
    number(image.height);
    number(image.width);
    text(image.encoding);
    bytes += image.is_big_endian ? '\1' : '\0';
    number(image.step);
    data(image.data);
  }
  std::string whole() const {
    return std::string{'\0', is_big_endian ? '\0' : '\1', '\0', '\0'} + bytes;
  }
};

}  // namespace

std::string packed_bytes(const std::string& packing, const std::string& bytes) {
  std::string into;
  if (packing == "zstd") {
    into.resize(ZSTD_compressBound(bytes.size()));
    into.resize(ZSTD_compress(into.data(), into.size(), bytes.data(), bytes.size(), 1));
  } else if (packing == "lz4") {
    into.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    into.resize(LZ4F_compressFrame(into.data(), into.size(), bytes.data(), bytes.size(), nullptr));
  } else {
    into = bytes;
  }
  return into;
}

std::string cdr_of(const BagImage& image, bool is_big_endian) {
  Message message{.bytes = {}, .is_cdr = true, .is_big_endian = is_big_endian};
  message.image(image);
  return message.whole();
}

std::string cdr_of(const BagPacked& image) {
  Message message;
  message.stamp(image.stamp);
  message.text("ceiling");
  message.text(image.format);
  message.data(image.data);
  return message.whole();
}

std::string ros1_of(const BagImage& image) {
  Message message{.bytes = {}, .is_cdr = false, .is_big_endian = false};
  message.number(7);
  message.image(image);
  return message.bytes;
}

WrittenMcap::WrittenMcap(std::string packing, int messages_a_chunk, std::string encoding)
    : packing_(std::move(packing)),
      most_(messages_a_chunk),
      encoding_(std::move(encoding)),
      bytes_(kMcapMagic) {
  bytes_ += mcap_record(1, counted_text("ros2") + counted_text("test"));
}

void WrittenMcap::add(const std::string& topic, const std::string& type, BagTime recorded,
                      const std::string& message) {
  std::string into;
  if (!channels_.contains(topic)) {
    const int number = static_cast<int>(channels_.size()) + 1;
    channels_[topic] = number;
    const auto id = static_cast<std::uint64_t>(number);
    into += mcap_record(3, little_endian(id, 2) + counted_text(type) + counted_text("ros2msg") +
                               counted_text("uint8 x"));
    into += mcap_record(4, little_endian(id, 2) + little_endian(id, 2) + counted_text(topic) +
                               counted_text(encoding_) + little_endian(0, 4));
  }
  const auto time = static_cast<std::uint64_t>(recorded);
  into += mcap_record(5, little_endian(static_cast<std::uint64_t>(channels_[topic]), 2) +
                             little_endian(0, 4) + little_endian(time, 8) + little_endian(time, 8) +
                             message);
  if (packing_ == "bare") {
    bytes_ += into;
    return;
  }
  chunk_ += into;
  if (++in_chunk_ == most_) close_chunk();
}

void WrittenMcap::close_chunk() {
  if (chunk_.empty()) return;
  const std::string inside = packed_bytes(packing_, chunk_);
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(chunk_.data()), static_cast<uInt>(chunk_.size()));
  bytes_ +=
      mcap_record(6, little_endian(0, 8) + little_endian(0, 8) + little_endian(chunk_.size(), 8) +
                         little_endian(crc, 4) + counted_text(packing_ == "none" ? "" : packing_) +
                         little_endian(inside.size(), 8) + inside);
  bytes_ +=
      mcap_record(7, little_endian(1, 2) + little_endian(0, 4));  // an index, which is not needed
  chunk_.clear();
  in_chunk_ = 0;
}

std::string WrittenMcap::finished() {
  close_chunk();
  return bytes_ + mcap_record(15, little_endian(0, 4)) + mcap_record(2, little_endian(0, 20)) +
         kMcapMagic;
}

WrittenDb3::WrittenDb3(const std::string& path) {
  sqlite3* base = nullptr;
  if (sqlite3_open(path.c_str(), &base) != SQLITE_OK) throw std::runtime_error(path);
  base_ = base;
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT "
      "NULL,serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL, timestamp INTEGER "
      "NOT NULL, data BLOB NOT NULL)");
  run("BEGIN");
}

WrittenDb3::~WrittenDb3() {
  sqlite3_exec(static_cast<sqlite3*>(base_), "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(static_cast<sqlite3*>(base_));
}

void WrittenDb3::add(const std::string& topic, const std::string& type, BagTime recorded,
                     const std::string& message) {
  if (!topics_.contains(topic)) {
    const int id = static_cast<int>(topics_.size()) + 1;
    topics_[topic] = id;
    run("INSERT INTO topics VALUES(" + std::to_string(id) + ",'" + topic + "','" + type +
        "','cdr','')");
  }
  run("INSERT INTO messages(topic_id,timestamp,data) VALUES(" + std::to_string(topics_[topic]) +
          "," + std::to_string(recorded) + ",?)",
      &message);
}

void WrittenDb3::run(const std::string& text, const std::string* blob) {
  auto* const base = static_cast<sqlite3*>(base_);
  sqlite3_stmt* query = nullptr;
  if (sqlite3_prepare_v2(base, text.c_str(), -1, &query, nullptr) != SQLITE_OK)
    throw std::runtime_error(text);
  if (blob != nullptr)
    sqlite3_bind_blob(query, 1, blob->data(), static_cast<int>(blob->size()), SQLITE_TRANSIENT);
  const int code = sqlite3_step(query);
  sqlite3_finalize(query);
  if (code != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(base));
}

}  // namespace swarmsmith
