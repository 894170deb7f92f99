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

/// How rows are written: aligned columns for people, or one JSON object
/// {"columns":[...],"rows":[{...}],"truncated":false}, or the same with each row a list.
enum class Form { Text, Json, JsonLists };

/// Rows of a query, held.
struct Rows {
  std::vector<std::string> columns;
  std::vector<std::vector<StoreReader::Cell>> cells;
  bool truncated = false;

  /// The place of a column; as many as there are if none has the name.
  std::size_t column(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
  }
};

/// Runs the statement and keeps its rows.
Expected<Rows> select(StoreReader& store, const std::string& sql,
                      const StoreReader::QueryLimits& limits = {});

/// Columns whose values are ids get the letter of their kind: design 3 becomes d3; `candidate`,
/// `parent` and `best_candidate` get a c.
void letter_ids(Rows& rows);

/// Whether programs gave all of the store's scores: then people who read it know costs.
bool is_of_programs(StoreReader& store);
/// The same rows in irace's words, for people: costs in place of scores, which are their negatives,
/// configurations in place of candidates, and nothing of machines.
void as_costs(Rows& rows);

/// Aligned columns below a headline, numbers on the right, six digits of reals.
std::string rows_as_text(Rows rows);
/// One line of CSV (base/text/csv.h), with its end; null is empty; full precision.
std::string cells_as_csv(const std::vector<StoreReader::Cell>& cells);
/// Numbers in full precision.
JsonPiece cell_as_json(const StoreReader::Cell& cell);
/// The "rows" array alone.
JsonPiece rows_as_json(const Rows& rows);
/// One row, to which keys may be added.
JsonObject row_as_json(const Rows& rows, std::size_t row);

/// Row by row, and frees each once it is written: a long answer is held once.
void write_rows(Output& output, Rows rows, Form form);
/// That there would be more than these.
void note_truncated(Output& output, std::size_t rows);

}  // namespace swarmsmith::cli
