#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/internal/btree_page.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What the records of a table look like. Our tables are STRICT, so that a record tells much about
/// where it belongs.
struct TableShape {
  struct Column {
    std::string name;
    std::string type;  ///< INTEGER, REAL, TEXT, BLOB
    bool may_be_null = false;
  };
  std::string name;
  /// Under which name sqlite_schema has the tree: the table's, or an index' of it.
  std::string tree;
  bool has_rowids = true;
  int alias = -1;  ///< the column that is the rowid, and NULL in the record
  /// In the order of the record.
  std::vector<Column> columns;
  std::size_t least_columns = 0;  ///< of a record from before the others were added

  /// Whether it can be a record of this table.
  bool fits(const StoredRecord& record) const;
  /// INSERT OR IGNORE of so many columns.
  std::string insertion(std::size_t count) const;
};

/// Of all tables of a database of ours, and of the one index that has all of a table: that of the
/// sources' names, without which no score says where it is from.
std::vector<TableShape> table_shapes(const sqlite::Connection& connection);

}  // namespace swarmsmith
