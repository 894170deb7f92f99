#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The pages of a database file as bytes; committed pages of its write-ahead log replace those of
/// the file. Reads only bytes: the file may be damaged anywhere.
/// https://www.sqlite.org/fileformat2.html, sections 1.2, 1.3 and 4
class PageImage {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// BadInput when the file cannot be read at all.
  static Expected<PageImage> read(const std::filesystem::path& file);

  /// Whether the first bytes are those of an SQLite database, with a valid page size.
  bool has_header() const { return has_header_; }
  /// Whether the header or the log gives the page size.
  bool knows_page_size() const { return has_header_ || !newer_.empty(); }
  std::size_t page_size() const { return page_size_; }
  /// For a file whose header does not give it.
  void set_page_size(std::size_t bytes);
  /// The numbers of the existing pages in order: those of the file, without a last one that is cut
  /// off, and those that only the log has. A damaged log may give pages any number.
  std::vector<std::uint32_t> numbers() const;
  /// Size of file and log: no record can be larger.
  std::uint64_t bytes() const;
  /// Page 1, 2, ...; empty when it does not exist.
  Bytes page(std::uint32_t number) const;
  /// PRAGMA user_version in the header.
  std::int64_t user_version() const;
  /// Unused pages, as far as they can be found from the header.
  std::vector<std::uint32_t> free_pages() const;

 private:
  void read_header();
  void read_log(const std::vector<std::uint8_t>& log);

  std::vector<std::uint8_t> bytes_;
  /// By number: the pages of the log that replace those of the file.
  std::unordered_map<std::uint32_t, std::vector<std::uint8_t>> newer_;
  std::size_t page_size_ = 8192;
  bool has_header_ = false;
};

/// A big-endian number of `count` bytes, which must exist.
std::uint64_t big_endian(PageImage::Bytes bytes, std::size_t at, std::size_t count);

}  // namespace swarmsmith
