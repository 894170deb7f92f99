#include "storage/internal/table_shape.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

using sqlite::Statement;

/// Whether a text can be from a store: well-formed UTF-8, with no control characters except line
/// ends, tabs and ESC.
bool is_text(const std::string& bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    if (byte < 0x20 && byte != '\n' && byte != '\r' && byte != '\t' && byte != 0x1b) return false;
    const std::size_t length = byte < 0x80        ? 1
                               : byte >> 5U == 6  ? 2
                               : byte >> 4U == 14 ? 3
                               : byte >> 3U == 30 ? 4
                                                  : 0;
    if (length == 0 || i + length > bytes.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(bytes[i + k]) & 0xc0U) != 0x80) return false;
    }
    i += length;
  }
  return true;
}

bool fits_column(const TableShape::Column& column, const StoredValue& value) {
  using Type = StoredValue::Type;
  switch (value.type) {
    case Type::Null:
      return column.may_be_null;
    case Type::Integer:  // SQLite also stores whole reals in this way
      return column.type == "INTEGER" || column.type == "REAL";
    case Type::Real:
      return column.type == "REAL" && std::isfinite(value.real);
    case Type::Text:
      return column.type == "TEXT" && is_text(value.bytes);
    case Type::Blob:
      return column.type == "BLOB";
  }
  return false;
}

}  // namespace

bool TableShape::fits(const StoredRecord& record) const {
  if (record.rowid.has_value() != has_rowids || record.values.size() > columns.size()) return false;
  if (record.values.empty() || record.values.size() < least_columns) return false;
  for (std::size_t i = 0; i < record.values.size(); ++i) {
    if (static_cast<int>(i) == alias) {
      if (record.values[i].type != StoredValue::Type::Null) return false;
    } else if (!fits_column(columns[i], record.values[i])) {
      return false;
    }
  }
  return true;
}

std::string TableShape::insertion(std::size_t count) const {
  std::string names;
  std::string values;
  for (std::size_t i = 0; i < count; ++i) {
    names += (i == 0 ? "" : ", ") + columns[i].name;
    values += i == 0 ? "?" : ",?";
  }
  return "INSERT OR IGNORE INTO " + name + " (" + names + ") VALUES (" + values + ")";
}

std::vector<TableShape> table_shapes(const sqlite::Connection& connection) {
  std::vector<TableShape> shapes;
  Statement table(connection,
                  "SELECT name, wr FROM pragma_table_list WHERE schema = 'main' AND type = 'table'"
                  " AND name NOT LIKE 'sqlite_%' ORDER BY name");
  while (table.step()) {
    TableShape shape{
        .name = table.text(0), .tree = table.text(0), .has_rowids = table.integer(1) == 0};
    // Records of tables without rowids begin with the columns of the key.
    Statement column(connection,
                     "SELECT name, type, \"notnull\", pk"
                     " FROM pragma_table_info(?1) ORDER BY iif(?2 AND pk > 0, pk, 1000 + cid)");
    column.bind(shape.name, !shape.has_rowids);
    while (column.step()) {
      const bool nullable = column.integer(2) == 0 && column.integer(3) == 0;
      if (shape.has_rowids && column.integer(3) > 0 && column.text(1) == "INTEGER") {
        shape.alias = static_cast<int>(shape.columns.size());
      }
      shape.columns.push_back(
          {.name = column.text(0), .type = column.text(1), .may_be_null = nullable});
    }
    shapes.push_back(std::move(shape));
  }
  shapes.push_back(
      {.name = "source",
       .tree = "sqlite_autoindex_source_1",
       .has_rowids = false,
       .columns = {{.name = "name", .type = "TEXT"}, {.name = "id", .type = "INTEGER"}}});
  return shapes;
}

}  // namespace swarmsmith
