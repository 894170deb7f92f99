#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The pages of a database file as bytes, with those of its write-ahead log that were committed in
/// place of the older ones. Reads nothing but bytes: the file may be damaged anywhere.
/// https://www.sqlite.org/fileformat2.html, sections 1.2, 1.3 and 4
class PageImage {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// BadInput when the file cannot be read at all.
  static Expected<PageImage> read(const std::filesystem::path& file);

  /// Whether the first bytes are those of a SQLite database, with a page size that can be.
  bool has_header() const { return has_header_; }
  /// The header or the log says how large pages are.
  bool knows_page_size() const { return has_header_ || !newer_.empty(); }
  std::size_t page_size() const { return page_size_; }
  /// For a file whose header does not say it.
  void set_page_size(std::size_t bytes);
  /// The pages that there are, in order: those of the file, where the last one may be cut off
  /// and is not counted then, and those that only the log has. A damaged log may give them any
  /// number.
  std::vector<std::uint32_t> numbers() const;
  /// Of file and log: no record can be larger.
  std::uint64_t bytes() const;
  /// Page 1, 2, ...; empty when there is none.
  Bytes page(std::uint32_t number) const;
  /// PRAGMA user_version, as the header says.
  std::int64_t user_version() const;
  /// Pages that hold nothing, as far as the header leads to them.
  std::vector<std::uint32_t> free_pages() const;

 private:
  void read_header();
  void read_log(const std::vector<std::uint8_t>& log);

  std::vector<std::uint8_t> bytes_;
  /// By number: what the log has in place of the file's.
  std::unordered_map<std::uint32_t, std::vector<std::uint8_t>> newer_;
  std::size_t page_size_ = 8192;
  bool has_header_ = false;
};

/// A big-endian number of so many bytes; they must be there.
std::uint64_t big_endian(PageImage::Bytes bytes, std::size_t at, std::size_t count);

}  // namespace swarmsmith
