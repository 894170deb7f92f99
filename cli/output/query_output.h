#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The format of rows: aligned columns for people, or one JSON object
/// {"columns":[...],"rows":[{...}],"truncated":false}, or the same object with each row as a list.
enum class Form { Text, Json, JsonLists };

/// The rows of a query, in memory.
struct Rows {
  std::vector<std::string> columns;
  std::vector<std::vector<StoreReader::Cell>> cells;
  bool truncated = false;

  /// The index of a column; the number of columns if there is no such name.
  std::size_t column(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
  }
};

/// Runs the statement and returns its rows.
Expected<Rows> select(StoreReader& store, const std::string& sql,
                      const StoreReader::QueryLimits& limits = {});

/// Adds the letter of their kind to columns of ids: design 3 becomes d3; `candidate`, `parent` and
/// `best_candidate` get a c.
void letter_ids(Rows& rows);

/// Whether all scores of the store come from programs. If so, its users expect costs.
bool is_of_programs(StoreReader& store);
/// Translates the rows to irace's terms, for people: costs instead of scores (the negative scores),
/// configurations instead of candidates, and no machines.
void as_costs(Rows& rows);

/// Aligned columns below a headline, numbers aligned on the right, real numbers with six digits.
std::string rows_as_text(Rows rows);
/// One line of CSV (base/text/csv.h), with its line end; null is written as nothing; numbers have
/// full precision.
std::string cells_as_csv(const std::vector<StoreReader::Cell>& cells);
/// Numbers have full precision.
JsonPiece cell_as_json(const StoreReader::Cell& cell);
/// Only the array "rows".
JsonPiece rows_as_json(const Rows& rows);
/// One row as an object, so that keys can be added.
JsonObject row_as_json(const Rows& rows, std::size_t row);

/// Writes row by row and frees each row after writing it, so that a long answer is in memory only
/// once.
void write_rows(Output& output, Rows rows, Form form);
/// Notes that there are more rows than these.
void note_truncated(Output& output, std::size_t rows);

}  // namespace swarmsmith::cli
