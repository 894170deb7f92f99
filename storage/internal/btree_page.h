#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/internal/page_image.h"

namespace swarmsmith {

/// A value of a record.
struct StoredValue {
  enum class Type { Null, Integer, Real, Text, Blob } type = Type::Null;
  std::int64_t integer = 0;
  double real = 0;
  std::string bytes;
};

/// The content of one cell.
struct StoredRecord {
  std::optional<std::int64_t> rowid;  ///< none in the trees of tables WITHOUT ROWID and of indices
  std::vector<StoredValue> values;
};

/// A page of a b-tree from a file that may be damaged: cells without a complete record are left
/// out.
/// https://www.sqlite.org/fileformat2.html, sections 1.6 and 2.1
struct BtreePage {
  bool is_leaf = false;
  bool has_rowids = false;  ///< of a table with rowids
  std::vector<std::uint32_t> children;
  std::vector<StoredRecord> records;
  std::int64_t broken = 0;  ///< number of cells without a complete record
};

/// Empty when the page is not a page of a b-tree. `chained` is how many bytes of overflow pages may
/// still be read; the function subtracts what it has read. In a damaged file every cell may lead to
/// the same long chain.
std::optional<BtreePage> read_btree_page(const PageImage& image, std::uint32_t number,
                                         std::uint64_t& chained);

}  // namespace swarmsmith
