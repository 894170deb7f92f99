#include "storage/internal/btree_page.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_set>

namespace swarmsmith {
namespace {

using Bytes = PageImage::Bytes;

/// Reads bytes from the left, until there are no more.
class Cursor {
 public:
  explicit Cursor(Bytes bytes) : bytes_(bytes) {}

  std::size_t at() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  /// A number with seven bits in each byte, and eight in the ninth.
  std::optional<std::uint64_t> varint() {
    std::uint64_t value = 0;
    for (int i = 0; i < 9; ++i) {
      if (left() == 0) return std::nullopt;
      const std::uint8_t byte = bytes_[at_++];
      if (i == 8) return value << 8U | byte;
      value = value << 7U | (byte & 0x7fU);
      if ((byte & 0x80U) == 0) return value;
    }
    return value;
  }
  Bytes rest() const { return bytes_.subspan(at_); }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

std::size_t size_of(std::uint64_t serial_type) {
  constexpr std::size_t kSizes[] = {0, 1, 2, 3, 4, 6, 8, 8, 0, 0};
  return serial_type < 10 ? kSizes[serial_type] : (serial_type - 12) / 2;
}

StoredValue value_of(std::uint64_t serial_type, Bytes bytes) {
  using Type = StoredValue::Type;
  StoredValue value;
  if (serial_type == 0) return value;
  if (serial_type >= 12) {
    value.type = serial_type % 2 == 0 ? Type::Blob : Type::Text;
    value.bytes.assign(bytes.begin(), bytes.end());
    return value;
  }
  if (serial_type == 7) {
    value.type = Type::Real;
    value.real = std::bit_cast<double>(big_endian(bytes, 0, 8));
    return value;
  }
  value.type = Type::Integer;
  if (serial_type >= 8) {
    value.integer = serial_type == 9 ? 1 : 0;
    return value;
  }
  const auto unused = static_cast<unsigned>(64 - 8 * bytes.size());
  value.integer = static_cast<std::int64_t>(big_endian(bytes, 0, bytes.size()) << unused) >> unused;
  return value;
}

/// The values that the header announces must end exactly at the last byte. Half of the payloads
/// that are not records fail this check.
std::optional<std::vector<StoredValue>> values_of(Bytes payload) {
  Cursor header(payload);
  const auto header_size = header.varint();
  if (!header_size || *header_size > payload.size() || *header_size < header.at()) return {};
  std::size_t at = *header_size;
  std::vector<StoredValue> values;
  while (header.at() < *header_size) {
    const auto type = header.varint();
    if (!type || *type == 10 || *type == 11 || header.at() > *header_size) return {};
    const std::size_t size = size_of(*type);
    if (size > payload.size() - at) return {};
    values.push_back(value_of(*type, payload.subspan(at, size)));
    at += size;
  }
  if (at != payload.size()) return {};
  return values;
}

/// A payload, including the part of it that is on overflow pages.
std::optional<std::vector<std::uint8_t>> payload_of(const PageImage& image, Bytes cell,
                                                    std::uint64_t size, bool has_rowids,
                                                    std::uint64_t& chained) {
  // The sizes of https://www.sqlite.org/fileformat2.html#b_tree_pages: `most` is X there, `least`
  // is M, and `kept` is K. All bytes of a page count as usable, since stores reserve none.
  const std::uint64_t usable = image.page_size();
  const std::uint64_t most = has_rowids ? usable - 35 : (usable - 12) * 64 / 255 - 23;
  const std::uint64_t least = (usable - 12) * 32 / 255 - 23;
  std::uint64_t here = size;
  if (size > most) {
    const std::uint64_t kept = least + (size - least) % (usable - 4);
    here = kept <= most ? kept : least;
  }
  if (size > image.bytes() || here + (size > most ? 4 : 0) > cell.size()) return {};
  std::vector<std::uint8_t> payload(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(here));
  if (size <= most) return payload;
  auto next = static_cast<std::uint32_t>(big_endian(cell, here, 4));
  std::unordered_set<std::uint32_t> passed;
  while (payload.size() < size) {
    const Bytes page = image.page(next);
    if (page.empty() || chained < usable || !passed.insert(next).second) return {};
    chained -= usable;
    const auto part = std::min<std::uint64_t>(size - payload.size(), usable - 4);
    payload.insert(payload.end(), page.begin() + 4,
                   page.begin() + 4 + static_cast<std::ptrdiff_t>(part));
    next = static_cast<std::uint32_t>(big_endian(page, 0, 4));
  }
  // A chain with more pages belongs to another record.
  if (next != 0) return {};
  return payload;
}

std::optional<StoredRecord> record_of(const PageImage& image, Bytes cell, bool has_rowids,
                                      std::uint64_t& chained) {
  Cursor cursor(cell);
  const auto size = cursor.varint();
  if (!size) return {};
  StoredRecord record;
  if (has_rowids) {
    const auto rowid = cursor.varint();
    if (!rowid) return {};
    record.rowid = static_cast<std::int64_t>(*rowid);
  }
  const auto payload = payload_of(image, cursor.rest(), *size, has_rowids, chained);
  if (!payload) return {};
  auto values = values_of(*payload);
  if (!values) return {};
  record.values = std::move(*values);
  return record;
}

}  // namespace

std::optional<BtreePage> read_btree_page(const PageImage& image, std::uint32_t number,
                                         std::uint64_t& chained) {
  const Bytes bytes = image.page(number);
  if (bytes.empty()) return {};
  const std::size_t start = number == 1 ? 100 : 0;
  const std::uint8_t kind = bytes[start];
  if (kind != 0x02 && kind != 0x05 && kind != 0x0a && kind != 0x0d) return {};
  BtreePage page;
  page.is_leaf = kind >= 0x0a;
  page.has_rowids = kind == 0x05 || kind == 0x0d;
  const std::size_t header = page.is_leaf ? 8 : 12;
  const std::uint64_t cells = big_endian(bytes, start + 3, 2);
  if (start + header + 2 * cells > bytes.size()) return {};
  for (std::uint64_t i = 0; i < cells; ++i) {
    std::size_t at = big_endian(bytes, start + header + 2 * i, 2);
    if (at < start + header + 2 * cells || at + 4 > bytes.size()) {
      ++page.broken;
      continue;
    }
    if (!page.is_leaf) {
      page.children.push_back(static_cast<std::uint32_t>(big_endian(bytes, at, 4)));
      at += 4;
      if (page.has_rowids) continue;
    }
    if (auto record = record_of(image, bytes.subspan(at), page.has_rowids, chained)) {
      page.records.push_back(std::move(*record));
    } else {
      ++page.broken;
    }
  }
  if (!page.is_leaf) {
    page.children.push_back(static_cast<std::uint32_t>(big_endian(bytes, start + 8, 4)));
  }
  return page;
}

}  // namespace swarmsmith
