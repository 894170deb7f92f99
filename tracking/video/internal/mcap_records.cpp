#include "tracking/video/internal/mcap_records.h"

extern "C" {
#include <libavutil/crc.h>
}

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <utility>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/ros_image.h"

namespace swarmsmith::mcap {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::int64_t kHead = 9;  // opcode and length
constexpr std::uint64_t kMostBytes = std::uint64_t{512} << 20;
/// Limits of decompression: `kMostOfFew` bytes from few compressed bytes, otherwise `kMostOfEach`
/// bytes per compressed byte. Even pictures of one colour, in chunks of the size that recorders
/// use, stay below.
constexpr std::uint64_t kMostOfFew = std::uint64_t{64} << 20;
constexpr std::uint64_t kMostOfEach = 50;

bool unpack_lz4(std::string_view packed, std::string& into) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return false;
  std::size_t done = 0;
  bool is_right = true;
  while (!packed.empty() && is_right) {
    std::size_t room = into.size() - done;
    std::size_t taken = packed.size();
    const std::size_t code =
        LZ4F_decompress(context, into.data() + done, &room, packed.data(), &taken, nullptr);
    is_right = LZ4F_isError(code) == 0 && (room > 0 || taken > 0);
    done += room;
    packed.remove_prefix(taken);
    if (code == 0) break;
  }
  LZ4F_freeDecompressionContext(context);
  return is_right && done == into.size();
}

bool unpack_zstd(std::string_view packed, std::string& into) {
  const std::size_t size = ZSTD_decompress(into.data(), into.size(), packed.data(), packed.size());
  return ZSTD_isError(size) == 0 && size == into.size();
}

std::uint32_t crc_of(std::string_view bytes) {
  // Older versions of the library take the size as `int`, newer ones as `size_t`.
  const auto* const table = av_crc_get_table(AV_CRC_32_IEEE_LE);
  return av_crc(table, UINT32_MAX, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                bytes.size()) ^
         UINT32_MAX;
}

}  // namespace

std::uint64_t Fields::number(std::size_t size) {
  const std::string_view from = bytes(size);
  std::uint64_t value = 0;
  for (std::size_t i = from.size(); i > 0; --i)
    value = value << 8U | static_cast<std::uint8_t>(from[i - 1]);
  return value;
}

std::string_view Fields::bytes(std::uint64_t size) {
  if (has_ended_ || size > rest_.size()) {
    has_ended_ = true;
    rest_ = {};
    return {};
  }
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

Records::Records(av::ByteStream bytes, std::string name)
    : bytes_(std::move(bytes)), name_(std::move(name)) {}

void Records::rewind() {
  at_ = 0;
  inside_ = {};
  is_over_ = false;
}

Unexpected Records::damaged(const std::string& what) const {
  return Unexpected(
      error_of(IssueCode::VideoUnreadable,
               fmt::format("is damaged at byte {}: {}; copy it again, or repair it with "
                           "`mcap recover`",
                           at_, what),
               name_));
}

Expected<std::optional<Record>> Records::next() {
  while (true) {
    if (inside_.empty()) {
      auto record = next_outside();
      if (!record || !*record || (*record)->opcode != Opcode::Chunk) return record;
      if (const auto unpacked = unpack(**record); !unpacked) return Unexpected(unpacked.error());
      continue;
    }
    Fields fields(inside_);
    Record record;
    record.opcode = static_cast<Opcode>(fields.number(1));
    record.content = fields.bytes(fields.number(8));
    if (fields.has_ended()) return damaged("a record goes on beyond its chunk");
    inside_ = fields.rest();
    // A chunk may not contain another chunk.
    if (record.opcode != Opcode::Chunk) return std::optional(record);
  }
}

Expected<std::optional<Record>> Records::next_outside() {
  const auto read = [&](std::int64_t from, std::size_t count) {
    record_.resize(count);
    return avio_seek(bytes_.io(), from, SEEK_SET) == from &&
           avio_read(bytes_.io(), reinterpret_cast<unsigned char*>(record_.data()),
                     static_cast<int>(count)) == static_cast<int>(count);
  };
  if (at_ == 0) {
    if (bytes_.size() == 0)
      return Unexpected(error_of(IssueCode::VideoUnreadable, "the file is empty", name_));
    if (!read(0, kMagic.size()) || record_ != kMagic) return damaged("it is not an MCAP file");
    at_ = static_cast<std::int64_t>(kMagic.size());
  }
  if (is_over_) return std::optional<Record>();
  // A truncated recording may end anywhere.
  if (bytes_.size() - at_ < kHead) {
    is_over_ = is_cut_ = true;
    return std::optional<Record>();
  }
  if (!read(at_, static_cast<std::size_t>(kHead))) return damaged("it cannot be read");
  Fields head(record_);
  const auto opcode = static_cast<Opcode>(head.number(1));
  const std::uint64_t size = head.number(8);
  if (opcode == Opcode::DataEnd) {
    is_over_ = true;
    return std::optional<Record>();
  }
  const auto left = static_cast<std::uint64_t>(bytes_.size() - at_ - kHead);
  if (size > left) {
    if (opcode == Opcode::Message || opcode == Opcode::Chunk) {
      is_over_ = is_cut_ = true;
      return std::optional<Record>();
    }
    return damaged("a record goes on beyond the file's end");
  }
  if (size > kMostBytes) return damaged("a record of more than 512 MB");
  if (!read(at_ + kHead, size)) return damaged("it cannot be read");
  at_ += kHead + static_cast<std::int64_t>(size);
  return std::optional(Record{opcode, record_});
}

Expected<void> Records::unpack(const Record& chunk) {
  Fields fields(chunk.content);
  fields.number(8);  // start time
  fields.number(8);  // end time
  const std::uint64_t size = fields.number(8);
  const auto crc = static_cast<std::uint32_t>(fields.number(4));
  const std::string packing = fields.text();
  const std::string_view packed = fields.bytes(fields.number(8));
  if (fields.has_ended()) return damaged("a chunk that is shorter than it says");
  if (size > kMostBytes) return damaged("a chunk of more than 512 MB");
  if (packing.empty()) {
    if (packed.size() != size) return damaged("a chunk that is not as long as it says");
    inside_ = packed;
  } else if (packing == "zstd" || packing == "lz4") {
    if (size > std::max(kMostOfFew, kMostOfEach * packed.size())) {
      return damaged(
          fmt::format("a chunk of {} bytes that expands to {} MB", packed.size(), size >> 20U));
    }
    unpacked_.resize(size);
    const bool is_right =
        packing == "zstd" ? unpack_zstd(packed, unpacked_) : unpack_lz4(packed, unpacked_);
    if (!is_right) return damaged("a chunk cannot be unpacked");
    inside_ = unpacked_;
  } else {
    return damaged("a chunk is packed with `" + shortened(packing) +
                   "`; zstd and lz4 are supported");
  }
  if (crc != 0 && crc != crc_of(inside_)) return damaged("a chunk's checksum is wrong");
  return {};
}

}  // namespace swarmsmith::mcap
