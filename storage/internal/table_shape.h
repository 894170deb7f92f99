#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/internal/btree_page.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// The form of a table's records. The tables are STRICT, so that a record shows to which tables it
/// may belong.
struct TableShape {
  struct Column {
    std::string name;
    std::string type;  ///< INTEGER, REAL, TEXT, BLOB
    bool may_be_null = false;
  };
  std::string name;
  /// The name in sqlite_schema of the b-tree: the table's, or that of one of its indexes.
  std::string tree;
  bool has_rowids = true;
  int alias = -1;  ///< index of the column that is the rowid, and NULL in the record; -1 if none
  /// In the order of the record.
  std::vector<Column> columns;
  std::size_t least_columns = 0;  ///< of a record from before the other columns were added

  /// Whether the record can be one of this table.
  bool fits(const StoredRecord& record) const;
  /// An INSERT OR IGNORE statement with `count` columns.
  std::string insertion(std::size_t count) const;
};

/// The shapes of all tables of a store, and of the one index that has all the data of its table:
/// the index of the sources' names, without which the source of every score is unknown.
std::vector<TableShape> table_shapes(const sqlite::Connection& connection);

}  // namespace swarmsmith
