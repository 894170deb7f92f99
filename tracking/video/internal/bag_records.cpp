#include "tracking/video/internal/bag_records.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <memory>
#include <utility>

namespace swarmsmith::bag {
namespace {

bool unpack_bz2(std::string& packed, std::string& into) {
  auto size = static_cast<unsigned>(into.size());
  return BZ2_bzBuffToBuffDecompress(into.data(), &size, packed.data(),
                                    static_cast<unsigned>(packed.size()), 0, 0) == BZ_OK &&
         size == into.size();
}

bool unpack_lz4(const std::string& packed, std::string& into) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t left = 1;
  while (left != 0) {
    std::size_t read = packed.size() - from;
    std::size_t written = into.size() - to;
    left = LZ4F_decompress(made, into.data() + to, &written, packed.data() + from, &read, nullptr);
    if (LZ4F_isError(left) != 0 || (left != 0 && read == 0 && written == 0)) return false;
    from += read;
    to += written;
  }
  return to == into.size();
}

}  // namespace

std::string text_in(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string() : found->second;
}

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

Read reading_of(const std::string& bytes) {
  return [&bytes](std::int64_t at, std::int64_t count) -> std::optional<std::string> {
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (at < 0 || count < 0 || at > size || count > size - at) return std::nullopt;
    return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(count));
  };
}

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

std::optional<std::string> unpacked(const Record& chunk, const Read& read) {
  const auto size = number_in<std::uint32_t>(chunk.fields, "size");
  auto packed = read(chunk.data, chunk.size());
  if (!size || *size > kMostChunk || !packed) return std::nullopt;
  const std::string packing = text_in(chunk.fields, "compression");
  if (packing == "none") return packed;
  std::string bytes(*size, '\0');
  const bool is_whole = packing == "bz2"   ? unpack_bz2(*packed, bytes)
                        : packing == "lz4" ? unpack_lz4(*packed, bytes)
                                           : false;
  return is_whole ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace swarmsmith::bag
