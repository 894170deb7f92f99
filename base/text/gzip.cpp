#include "base/text/gzip.h"

#include <zlib.h>

#include <array>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// A window of 15 bits, and 16 for the gzip header.
constexpr int kGzip = 15 + 16;

Bytef* zlib_bytes(std::string_view text) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib only reads it
  return const_cast<Bytef*>(reinterpret_cast<const Bytef*>(text.data()));
}

}  // namespace

std::string gzip(std::string_view bytes, int level) {
  z_stream stream = {};
  const int begun =
      deflateInit2(&stream, level, Z_DEFLATED, kGzip, MAX_MEM_LEVEL - 1, Z_DEFAULT_STRATEGY);
  SWARMSMITH_ASSERT(begun == Z_OK, "zlib has room for its state");
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = zlib_bytes(bytes);
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int ended = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  SWARMSMITH_ASSERT(ended == Z_STREAM_END, "zlib needs no more room than it said");
  return packed;
}

Expected<std::string> gunzip(std::string_view packed, std::size_t most) {
  z_stream stream = {};
  const int begun = inflateInit2(&stream, kGzip);
  SWARMSMITH_ASSERT(begun == Z_OK, "zlib has room for its state");
  stream.next_in = zlib_bytes(packed);
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  std::array<char, 16384> part{};
  int state = Z_OK;
  while (state == Z_OK && bytes.size() <= most) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state == Z_STREAM_END && bytes.size() <= most) return bytes;
  return unexpected(ErrorKind::Corrupt, state == Z_STREAM_END || state == Z_OK
                                            ? "unpacked, it is larger than the limit"
                                            : "this is not a whole gzip file");
}

}  // namespace swarmsmith
