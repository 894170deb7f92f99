#include "storage/internal/page_image.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/sqlite.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kHeader = 100;
constexpr std::size_t kLogHeader = 32;
constexpr std::size_t kFrameHeader = 24;

/// The bytes of the database. SQLite opens the file, since no other code may open it.
std::vector<std::uint8_t> bytes_of_database(const std::filesystem::path& file) {
  const sqlite::Connection connection(file.string(), SQLITE_OPEN_READONLY);
  const std::string bytes = connection.file_bytes(0, connection.file_size());
  return {bytes.begin(), bytes.end()};
}

/// The bytes of the log, on which SQLite has no locks.
Expected<std::vector<std::uint8_t>> bytes_of_log(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return bad_input("cannot be opened for reading", file.string());
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream),
                                  std::istreambuf_iterator<char>()};
  if (stream.bad()) return bad_input("cannot be read", file.string());
  return bytes;
}

bool is_page_size(std::uint64_t bytes) {
  return bytes >= 512 && bytes <= 65536 && std::has_single_bit(bytes);
}

/// The running checksum of the log over 32-bit words, in the byte order that its header names.
class LogSum {
 public:
  explicit LogSum(bool big) : big_(big) {}

  void add(PageImage::Bytes bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first_ += word(bytes, at) + second_;
      second_ += word(bytes, at + 4) + first_;
    }
  }
  bool is(PageImage::Bytes bytes, std::size_t at) const {
    return big_endian(bytes, at, 4) == first_ && big_endian(bytes, at + 4, 4) == second_;
  }

 private:
  std::uint32_t word(PageImage::Bytes bytes, std::size_t at) const {
    const auto value = static_cast<std::uint32_t>(big_endian(bytes, at, 4));
    return big_ ? value : __builtin_bswap32(value);
  }

  bool big_;
  std::uint32_t first_ = 0;
  std::uint32_t second_ = 0;
};

}  // namespace

std::uint64_t big_endian(PageImage::Bytes bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << 8U | bytes[at + i];
  return value;
}

Expected<PageImage> PageImage::read(const std::filesystem::path& file) {
  PageImage image;
  try {
    image.bytes_ = bytes_of_database(file);
  } catch (const sqlite::SqliteError& error) {
    return bad_input(fmt::format("cannot be read: {}", error.what()), file.string());
  }
  image.read_header();
  const std::filesystem::path log = file.string() + "-wal";
  std::error_code none;
  if (std::filesystem::exists(log, none)) {
    if (const auto logged = bytes_of_log(log)) image.read_log(*logged);
  }
  return image;
}

void PageImage::read_header() {
  constexpr std::string_view kBegin{"SQLite format 3\0", 16};
  const bool begins =
      bytes_.size() >= kHeader &&
      std::equal(kBegin.begin(), kBegin.end(), bytes_.begin(),
                 [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  const std::uint64_t said = begins ? big_endian(bytes_, 16, 2) : 0;
  const std::uint64_t size = said == 1 ? 65536 : said;
  has_header_ = is_page_size(size);
  set_page_size(has_header_ ? size : page_size_);
}

void PageImage::set_page_size(std::size_t bytes) {
  page_size_ = bytes;
}

/// Only frames up to the last one that ends a transaction count. Later frames, and frames that do
/// not fit the checksum, were never committed.
void PageImage::read_log(const std::vector<std::uint8_t>& log) {
  if (log.size() < kLogHeader) return;
  const std::uint64_t magic = big_endian(log, 0, 4);
  const std::uint64_t size = big_endian(log, 8, 4);
  if ((magic | 1U) != 0x377f0683 || !is_page_size(size)) return;
  if (has_header_ && size != page_size_) return;
  // The last bit of the magic number is the byte order of the checksums
  // (https://www.sqlite.org/fileformat2.html#walformat).
  LogSum sum((magic & 1U) != 0);
  const Bytes all(log);
  sum.add(all.first(24));
  if (!sum.is(all, 24)) return;
  std::unordered_map<std::uint32_t, std::vector<std::uint8_t>> open;
  for (std::size_t at = kLogHeader; at + kFrameHeader + size <= log.size();
       at += kFrameHeader + size) {
    const Bytes header = all.subspan(at, kFrameHeader);
    const Bytes page = all.subspan(at + kFrameHeader, size);
    if (!std::ranges::equal(header.subspan(8, 8), all.subspan(16, 8)))
      break;  // a frame of an older log
    sum.add(header.first(8));
    sum.add(page);
    if (!sum.is(header, 16)) break;
    open[static_cast<std::uint32_t>(big_endian(header, 0, 4))].assign(page.begin(), page.end());
    if (big_endian(header, 4, 4) == 0) continue;
    for (auto& [number, bytes] : open)
      newer_[number] = std::move(bytes);
    open.clear();
  }
  set_page_size(size);
  const Bytes first = page(1);
  has_header_ = has_header_ || newer_.contains(1);
  if (newer_.contains(1) && bytes_.size() >= kHeader)
    std::copy_n(first.begin(), kHeader, bytes_.begin());
}

std::vector<std::uint32_t> PageImage::numbers() const {
  constexpr std::uint64_t kMostPages = 0xfffffffe;  // SQLite's own limit
  const std::uint64_t in_file = std::min<std::uint64_t>(bytes_.size() / page_size_, kMostPages);
  std::vector<std::uint32_t> numbers;
  for (std::uint64_t number = 1; number <= in_file; ++number)
    numbers.push_back(static_cast<std::uint32_t>(number));
  for (const auto& [number, page] : newer_)
    if (number > in_file) numbers.push_back(number);
  std::sort(numbers.begin() + static_cast<std::ptrdiff_t>(in_file), numbers.end());
  return numbers;
}

std::uint64_t PageImage::bytes() const {
  std::uint64_t bytes = bytes_.size();
  for (const auto& [number, page] : newer_)
    bytes += page.size();
  return bytes;
}

PageImage::Bytes PageImage::page(std::uint32_t number) const {
  if (const auto newer = newer_.find(number); newer != newer_.end()) return newer->second;
  if (number == 0 || std::uint64_t{number} * page_size_ > bytes_.size()) return {};
  return Bytes(bytes_).subspan((number - 1) * page_size_, page_size_);
}

std::int64_t PageImage::user_version() const {
  return has_header_ && bytes_.size() >= kHeader
             ? static_cast<std::int32_t>(big_endian(bytes_, 60, 4))
             : 0;
}

std::vector<std::uint32_t> PageImage::free_pages() const {
  std::vector<std::uint32_t> free;
  if (!has_header_ || bytes_.size() < kHeader) return free;
  auto trunk = static_cast<std::uint32_t>(big_endian(bytes_, 32, 4));
  while (trunk != 0 && free.size() < bytes() / page_size_) {
    const Bytes bytes = page(trunk);
    if (bytes.empty()) break;
    free.push_back(trunk);
    const std::uint64_t leaves =
        std::min<std::uint64_t>(big_endian(bytes, 4, 4), page_size_ / 4 - 2);
    for (std::uint64_t i = 0; i < leaves; ++i)
      free.push_back(static_cast<std::uint32_t>(big_endian(bytes, 8 + 4 * i, 4)));
    trunk = static_cast<std::uint32_t>(big_endian(bytes, 0, 4));
  }
  return free;
}

}  // namespace swarmsmith
